"""Robot → what it can do: torque profiles, motor requirements, trials."""
