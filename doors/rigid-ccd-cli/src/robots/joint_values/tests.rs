use super::*;

#[test]
fn positions_have_units() {
    let range: JointRange = "knee=-90deg:40deg".parse().unwrap();
    assert_eq!(range.joint, "knee");
    assert!((range.from + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((range.to - 40f64.to_radians()).abs() < 1e-15);
    assert!(!range.is_at_rest());
    let slider: JointRange = "slider=12mm".parse().unwrap();
    assert_eq!((slider.from, slider.to), (0.012, 0.012));
    assert!(slider.is_at_rest());
    assert_eq!(length("0.3mm"), Ok(0.0003));
    assert_eq!(length("0.005"), Ok(0.005));
}

#[test]
fn other_texts_are_refused() {
    for text in [
        "knee", "knee=", "knee=a", "knee=1:b", "knee=inf", "knee=1ft",
    ] {
        assert!(text.parse::<JointRange>().is_err(), "{text}");
    }
    assert!(length("-1mm").is_err() && length("nan").is_err());
}
