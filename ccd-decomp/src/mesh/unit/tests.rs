use super::{Unit, UnitConversion, UnknownUnit};
use ccd_core::glam::DVec3;
use dashu_ratio::RBig;
use proptest::prelude::*;

#[test]
fn units_are_named_by_their_signs() {
    for unit in Unit::ALL {
        assert_eq!(unit.to_string().parse(), Ok(unit));
    }
    let error = "mil".parse::<Unit>().unwrap_err();
    assert_eq!(error, UnknownUnit { name: "mil".into() });
    let expected = "there is no unit \"mil\"; use um, mm, cm, m, in or ft";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn lengths_are_those_of_the_units() {
    let one = |from, to| UnitConversion::new(from, to).apply(DVec3::ONE).x;
    assert_eq!(one(Unit::Metre, Unit::Millimetre), 1000.0);
    assert_eq!(one(Unit::Millimetre, Unit::Metre), 0.001);
    assert_eq!(one(Unit::Metre, Unit::Micrometre), 1e6);
    assert_eq!(one(Unit::Centimetre, Unit::Millimetre), 10.0);
    assert_eq!(one(Unit::Inch, Unit::Millimetre), 25.4);
    assert_eq!(one(Unit::Foot, Unit::Inch), 12.0);
    assert_eq!(one(Unit::Inch, Unit::Foot), 1.0 / 12.0);
    assert_eq!(one(Unit::Foot, Unit::Metre), 0.3048);
    for unit in Unit::ALL {
        assert_eq!(one(unit, unit), 1.0);
    }
}

/// Returns a coordinate in another unit as an exact fraction.
fn exact_in_unit(x: f64, from: Unit, to: Unit) -> RBig {
    let ratio =
        RBig::from(from.symbol_and_micrometres().1) / RBig::from(to.symbol_and_micrometres().1);
    RBig::try_from(x).unwrap() * ratio
}

fn error(x: f64, from: Unit, to: Unit) -> RBig {
    let converted = UnitConversion::new(from, to).apply(DVec3::splat(x)).y;
    let difference = RBig::try_from(converted).unwrap() - exact_in_unit(x, from, to);
    if difference < RBig::ZERO {
        -difference
    } else {
        difference
    }
}

const METRIC_UNITS: [Unit; 4] = [
    Unit::Micrometre,
    Unit::Millimetre,
    Unit::Centimetre,
    Unit::Metre,
];

proptest! {
    #[test]
    fn a_coordinate_is_rounded_once_between_metric_units(x in -1e12..1e12_f64, from in 0..4_usize, to in 0..4_usize) {
        let (from, to) = (METRIC_UNITS[from], METRIC_UNITS[to]);
        let converted = UnitConversion::new(from, to).apply(DVec3::splat(x)).x;
        let half = RBig::try_from((converted.abs().next_up() - converted.abs()) / 2.0).unwrap();
        prop_assert!(error(x, from, to) <= half);
    }

    #[test]
    fn a_coordinate_is_rounded_twice_at_most(x in -1e12..1e12_f64, from in 0..6_usize, to in 0..6_usize) {
        let (from, to) = (Unit::ALL[from], Unit::ALL[to]);
        let converted = UnitConversion::new(from, to).apply(DVec3::splat(x)).x;
        let allowed = RBig::try_from(converted.abs() * f64::EPSILON * 1.01).unwrap();
        prop_assert!(error(x, from, to) <= allowed);
    }

    /// Tests that the f32 coordinates of a glTF are converted exactly to smaller metric units.
    #[test]
    fn floats_are_exact_towards_smaller_units(x in -1e6..1e6_f32, to in 0..4_usize) {
        prop_assert!(error(x.into(), Unit::Metre, METRIC_UNITS[to]).is_zero());
    }
}
