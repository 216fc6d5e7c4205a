# Sourced by the scripts that measure pairs of meshes: their arguments, and the pairs.
# The arguments are SCENES PROGRAM [OUT] [extra options ...]; the extra options remain in "$@".
scenes=$1
program=$2
out=${3:-$(mktemp -d)}
shift $(($# < 3 ? $# : 3))
mkdir -p "$out"
ccd=${CCD:-$here/../../target/release/ccd}
core=${CORE:-1}
# Name, body A, body B, motions.
pairs="knot2880 knot2880 knot2880 knots
knot11520 knot11520 knot11520 knots
knot34560 knot34560 knot34560 knots
ring ring ring rings
bunny70k bunny70k bunny70k bunnies
bunny26k bunny26k bunny26k bunnies
santa santa board santa"
