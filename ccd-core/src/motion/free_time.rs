//! A time for which two pieces are proven to stay apart.

use crate::math::order::greater;

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

    /// Returns up to the end if that is proven, and no time otherwise.
    #[inline]
    pub(crate) fn to_end_if(proven: bool) -> Self {
        if proven {
            FreeTime::ToEnd
        } else {
            FreeTime::NONE
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

    /// Returns the clock until which the pieces stay apart, if the present clock is `s`. The end of the query is 1.
    #[inline]
    pub(crate) fn clock_after(self, s: f64) -> f64 {
        match self {
            // One step down undoes the rounding of the sum.
            FreeTime::AtLeast(time) => greater(s, (s + time).next_down()),
            FreeTime::ToEnd => 1.0,
        }
    }
}

#[cfg(test)]
mod tests;
