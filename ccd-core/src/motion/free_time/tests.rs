use super::FreeTime;

impl FreeTime {
    /// Returns the time; `None` up to the end.
    pub(crate) fn bounded(self) -> Option<f64> {
        match self {
            FreeTime::AtLeast(time) => Some(time),
            FreeTime::ToEnd => None,
        }
    }
}

#[test]
fn the_longer_of_two_is_kept() {
    let [short, long] = [1.0, 2.0].map(FreeTime::AtLeast);
    for (one, other, longer) in [
        (short, long, long),
        (long, short, long),
        (short, FreeTime::ToEnd, FreeTime::ToEnd),
        (FreeTime::NONE, FreeTime::AtLeast(f64::NAN), FreeTime::NONE),
    ] {
        assert_eq!(one.or_longer(|_| other), longer);
    }
    let untried = FreeTime::ToEnd.or_longer(|_| panic!("nothing is longer"));
    assert_eq!(untried, FreeTime::ToEnd);
}

#[test]
fn a_clock_is_no_later_than_the_free_time_and_no_earlier_than_now() {
    for (free, clock) in [
        (FreeTime::NONE, 0.25),
        (FreeTime::AtLeast(f64::NAN), 0.25),
        (FreeTime::AtLeast(0.5), 0.75f64.next_down()),
        (FreeTime::ToEnd, 1.0),
    ] {
        assert_eq!(free.clock_after(0.25), clock, "{free:?}");
    }
}

#[test]
fn a_time_that_is_not_a_number_is_not_up_to_the_end() {
    assert_eq!(FreeTime::up_to(0.5, 0.5), FreeTime::ToEnd);
    assert_eq!(FreeTime::up_to(0.4, 0.5), FreeTime::AtLeast(0.4));
    assert_ne!(FreeTime::up_to(f64::NAN, 0.5), FreeTime::ToEnd);
}
