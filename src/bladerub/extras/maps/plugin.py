"""Maps of coatings in Python."""

PUBLIC = dict.fromkeys(("Map", "read_map", "simulate_speeds"), "extras.maps.interface")
