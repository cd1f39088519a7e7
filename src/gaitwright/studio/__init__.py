"""The studio: what a person sees and changes while a robot walks."""
