use super::*;
use proptest::prelude::*;

/// Generates vectors of whole numbers so small that floating-point arithmetic computes their determinants exactly.
fn integer_vector_strategy() -> impl Strategy<Value = DVec3> {
    [-9..=9, -9..=9, -9..=9].prop_map(|x: [i32; 3]| DVec3::from_array(x.map(f64::from)))
}

proptest! {
    #[test]
    fn whole_numbers_agree_with_plain_arithmetic(t in [integer_vector_strategy(), integer_vector_strategy(), integer_vector_strategy()], p in integer_vector_strategy()) {
        let [a, b, c] = t;
        let height = (b - a).cross(c - a).dot(p - a);
        prop_assert_eq!(side_of_plane(t, p), height.partial_cmp(&0.0).unwrap());
        prop_assert_eq!(is_degenerate(t), (b - a).cross(c - a) == DVec3::ZERO);
        if let Some(plane) = Projection::new(t) {
            prop_assert_eq!(plane.turn(a, b, c), Ordering::Greater);
            prop_assert_eq!(plane.turn(b, a, c), Ordering::Less);
            prop_assert_eq!(plane.turn(a, b, a + 3.0 * (b - a)), Ordering::Equal);
            // The far corner, mirrored at the middle of the edge.
            prop_assert_eq!(plane.turn(a, b, a + b - c), Ordering::Less);
        }
    }
}
