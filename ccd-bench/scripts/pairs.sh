# The pairs of meshes to measure: name, body A, body B, motions. Sourced by the other scripts.
pairs="knot2880 knot2880 knot2880 knots
knot11520 knot11520 knot11520 knots
knot34560 knot34560 knot34560 knots
ring ring ring rings
bunny70k bunny70k bunny70k bunnies
bunny26k bunny26k bunny26k bunnies
santa santa board santa"
