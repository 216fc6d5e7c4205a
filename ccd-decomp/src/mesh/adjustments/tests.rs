use super::*;

#[test]
fn adjustments_add_up() {
    let small = Adjustments::NONE.scaled(0.5).unwrap().mirrored(Axis::Y);
    let both = small
        .combined_with(&Adjustments::NONE.scaled(4.0).unwrap().treated_as_hollow())
        .unwrap();
    assert_eq!(both.to_string(), "@scale=2@mirror=y@surface");
    assert_eq!(
        both.affine_map().unwrap().apply(DVec3::ONE),
        DVec3::new(2.0, -2.0, 2.0)
    );
    let twice = small.combined_with(&small).unwrap();
    assert_eq!(twice.to_string(), "@scale=0.25");
    let stated = Adjustments::NONE.with_stated_unit(Unit::Inch);
    let wanted = Adjustments::NONE.with_target_unit(Unit::Metre);
    let units = stated.combined_with(&wanted).unwrap();
    assert_eq!(
        (units.stated_unit, units.target_unit),
        (Some(Unit::Inch), Some(Unit::Metre))
    );
    assert_eq!(Adjustments::NONE.affine_map(), None);
}

#[test]
fn factors_are_positive_numbers_and_stay_so() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Adjustments::NONE.scaled(bad);
        assert!(
            matches!(
                refused,
                Err(InputError::OutOfRange {
                    quantity: "scale",
                    ..
                })
            ),
            "{bad}"
        );
    }
    for (one, other) in [(1e200, 1e200), (1e-200, 1e-200)] {
        let scaled = Adjustments::NONE.scaled(one).unwrap();
        assert!(scaled.scaled(other).is_err());
        assert!(scaled.combined_with(&scaled).is_err());
    }
}
