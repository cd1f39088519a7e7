"""The learned controller: torque profiles played back, and what is regulated beside them."""
