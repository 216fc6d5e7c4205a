//! A time for which two pieces are proven to stay apart.

/// A time for which two pieces certainly stay apart from the present clock on.
///
/// Times are ordered: up to the end is longest.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) enum FreeTime {
    /// They stay apart for at least so long; [`FreeTime::NONE`] proves nothing.
    AtLeast(f64),
    /// They stay apart up to the end of the query.
    ToEnd,
}

impl FreeTime {
    /// Nothing is proven.
    pub(crate) const NONE: FreeTime = FreeTime::AtLeast(0.0);

    /// Makes a free time of a time; it is up to the end if the time reaches that.
    #[inline]
    pub(crate) fn up_to(time: f64, end: f64) -> Self {
        // Written so that NaN is not up to the end.
        if time >= end {
            FreeTime::ToEnd
        } else {
            FreeTime::AtLeast(time)
        }
    }

    /// Returns the longer one of this time and what another proof gives. The proof gets the time so far, and is not
    /// tried if that is up to the end.
    #[inline]
    pub(crate) fn or_longer(self, prove: impl FnOnce(f64) -> FreeTime) -> Self {
        let FreeTime::AtLeast(free) = self else {
            return FreeTime::ToEnd;
        };
        let other = prove(free);
        if other > self { other } else { self }
    }

    /// Returns the time; `None` up to the end.
    #[cfg(test)]
    pub(crate) fn bounded(self) -> Option<f64> {
        match self {
            FreeTime::AtLeast(time) => Some(time),
            FreeTime::ToEnd => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::FreeTime;

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
    fn a_time_that_is_not_a_number_is_not_up_to_the_end() {
        assert_eq!(FreeTime::up_to(0.5, 0.5), FreeTime::ToEnd);
        assert_eq!(FreeTime::up_to(0.4, 0.5), FreeTime::AtLeast(0.4));
        assert_ne!(FreeTime::up_to(f64::NAN, 0.5), FreeTime::ToEnd);
    }
}
