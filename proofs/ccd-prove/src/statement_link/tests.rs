use super::*;

fn link(axes: u32, [velocity, axis]: [[f64; 3]; 2], [start, rate]: [f64; 2]) -> StatementLink {
    StatementLink {
        parent: 0,
        position: [0.0; 3],
        quaternion: [0.0, 0.0, 0.0, 1.0],
        center: [0.0; 3],
        axes,
        velocity,
        axis,
        start,
        rate,
    }
}

#[test]
fn a_free_motion_is_returned_with_rate_one() {
    let scaled = link(0, [[0.0, 0.0, -0.25], [0.75, 0.0, 0.0]], [0.0, 4.0]);
    let unscaled = link(0, [[0.0, 0.0, -1.0], [3.0, 0.0, 0.0]], [0.0, 1.0]);
    assert_eq!(scaled.without_scaling(), unscaled);
    assert_eq!(scaled.numbers(), unscaled.numbers());
    // A link that was not scaled by a power of two, or does not start at 0, stays as it is.
    for other in [
        link(0, [[0.0, 0.0, -0.25], [0.0; 3]], [0.0, 3.0]),
        link(0, [[0.0, 0.0, -0.25], [0.0; 3]], [1.0, 4.0]),
        link(0, [[5e-324, 0.0, 1.0], [0.0; 3]], [0.0, 0.5]),
        link(0, [[0.0; 3]; 2], [0.0, 0.0]),
    ] {
        assert_eq!(other.without_scaling(), other);
    }
}

#[test]
fn a_joint_is_returned_with_an_axis_of_length_one() {
    let diagonal = 1.0 / 3f64.sqrt();
    for axis in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [diagonal; 3]] {
        for power in [-30, 0, 3] {
            let scale = 2f64.powi(power);
            let parameter = [0.3 / scale, -1.2 / scale];
            let scaled = link(1, [axis.map(|x| x * scale), [0.0; 3]], parameter);
            let unscaled = link(1, [axis, [0.0; 3]], [0.3, -1.2]);
            assert_eq!(scaled.without_scaling(), unscaled);
            assert_eq!(scaled.numbers(), unscaled.numbers());
        }
    }
}
