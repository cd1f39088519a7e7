"""What claims are measured with: oracles, random schools, moments of real gaits."""
