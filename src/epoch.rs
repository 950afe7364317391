//! Epochs as modified Julian dates in two parts, a whole day and a fraction, so that a present-day date keeps 1e-16 day (10
//! ps).
//!
//! A single double holds MJD 55000 to 7e-12 day, 0.6 microseconds. The time scale is that of the dates supplied; for arrival times
//! at the solar-system barycentre it is TDB.
//!
//! ```
//! use twofold::epoch::{Epoch, DAY};
//!
//! let start: Epoch = "55321.1234567890123456".parse()?;
//! let later = start.after([20.0 * 365.25 * DAY, 1e-9])?;
//! let [seconds, rest] = later.seconds_since(&start);
//! assert!((seconds - 631_152_000.0) + (rest - 1e-9) < 1e-11);
//! assert_eq!(Epoch::new(start.day(), start.fraction())?, start.to_string().parse()?);
//! # Ok::<(), twofold::Error>(())
//! ```

use core::fmt;
use core::str::FromStr;

use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;

pub use crate::units::DAY;

/// Latest day, some 27,000 years from the first.
const LAST_DAY: f64 = 1e7;

/// Longest time from an epoch in days.
const LONGEST: f64 = 1e9;

const ALLOWED: &str = "a modified Julian date from 0 to 1e7";

/// A modified Julian date.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Epoch {
    day: i64,
    /// In [0, 1).
    fraction: f64,
}

impl Epoch {
    /// The date `day + fraction`, any finite fraction.
    ///
    /// # Errors
    /// [`Error::Domain`] unless the date is from 0 to 1e7.
    pub fn new(day: i64, fraction: f64) -> Result<Self, Error> {
        let date = day as f64 + fraction;
        // The parts are checked as well: large parts of opposite sign lose the date.
        let near = day.unsigned_abs() <= 2 * LAST_DAY as u64;
        Error::ensure(near && (0.0..=LAST_DAY).contains(&date), "epoch (MJD)", date, ALLOWED)?;
        Ok(Self { day, fraction: 0.0 }.with_days(fraction.into()))
    }

    /// Whole part of the date (days).
    pub fn day(&self) -> i64 {
        self.day
    }

    /// Fraction of the day that is added to [`day`](Self::day), in [0, 1).
    pub fn fraction(&self) -> f64 {
        self.fraction
    }

    /// Time from `other` to this epoch in s, as the unevaluated sum of two doubles, of 32 digits.
    pub fn seconds_since(&self, other: &Self) -> [f64; 2] {
        let days = DoubleDouble::product((self.day - other.day) as f64, DAY);
        (days + DoubleDouble::sum(self.fraction, -other.fraction) * DAY).into()
    }

    /// The epoch later by a given time (s, the unevaluated sum of two doubles), rounded to 1e-16 day. It may lie before the
    /// date 0.
    ///
    /// # Errors
    /// [`Error::Domain`] for a time that is not finite or longer than 1e9 days, some three million years.
    pub fn after(&self, seconds: [f64; 2]) -> Result<Self, Error> {
        let days = (seconds[0] + seconds[1]) / DAY;
        Error::ensure(days.abs() <= LONGEST, "time from an epoch (d)", days, "at most 1e9 days in either direction")?;
        Ok(self.with_days(DoubleDouble::from(seconds) / DAY))
    }

    fn with_days(self, days: DoubleDouble) -> Self {
        let whole = days.high.floor();
        let fraction = DoubleDouble::sum(days.high - whole, self.fraction) + days.low.into();
        let more = fraction.high.floor();
        let fraction = (fraction.high - more) + fraction.low;
        let day = self.day + whole as i64 + more as i64;
        // A negative remainder below the rounding of one leaves a fraction of one.
        if fraction >= 1.0 { Self { day: day + 1, fraction: 0.0 } } else { Self { day, fraction: fraction.max(0.0) } }
    }
}

impl fmt::Display for Epoch {
    /// The shortest decimal number that identifies the epoch. Dates before 0, which only [`Epoch::after`] can produce, are
    /// rounded.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (sign, day, fraction) = match (self.day, 1.0 - self.fraction) {
            // A fraction below the rounding of one is lost here, too.
            (day, 1.0) if day < 0 => ("-", -day, 0.0),
            (day, rest) if day < 0 => ("-", -day - 1, rest),
            (day, _) => ("", day, self.fraction),
        };
        // Written without an exponent, as `0.25`.
        let fraction = format!("{fraction}");
        write!(f, "{sign}{day}.{}", fraction.split_once('.').map_or("0", |(_, digits)| digits))
    }
}

impl FromStr for Epoch {
    type Err = Error;

    /// Reads `55321.25` or `55321`, the fraction rounded to the nearest double.
    fn from_str(text: &str) -> Result<Self, Error> {
        let malformed = || Error::Unsupported {
            what: "epoch (MJD)",
            why: "must be a decimal number from 0 to 1e7, without a sign or an exponent",
        };
        let (day, fraction) = text.split_once('.').unwrap_or((text, "0"));
        let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        if !digits(day) || !digits(fraction) {
            return Err(malformed());
        }
        let day = day.parse().map_err(|_| malformed())?;
        Self::new(day, format!("0.{fraction}").parse().map_err(|_| malformed())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn epoch(text: &str) -> Epoch {
        text.parse().expect("a date")
    }

    #[test]
    fn text_is_read_and_written_without_loss() {
        for text in
            ["0.0", "55321.0", "51544.5", "59999.9999999999999999", "55321.1234567890123456", "60000.000000000000001"]
        {
            let read = epoch(text);
            assert_eq!(epoch(&read.to_string()), read, "{text}");
        }
        assert_eq!(epoch("55321.25").to_string(), "55321.25");
        assert_eq!(epoch("55321").to_string(), "55321.0");
        let read = epoch("55321.1234567890123456");
        assert!((read.fraction() - 0.123_456_789_012_345_6).abs() < 1e-17 && read.day() == 55321);
        // The last digits of a day round up to the next day.
        assert_eq!(epoch("59999.99999999999999999").to_string(), "60000.0");
    }

    #[test]
    fn the_limits_of_dates_and_times_are_checked_on_both_sides() {
        assert!(Epoch::new(19_000_000, -1.85e7).is_ok() && Epoch::new(21_000_000, -2.05e7).is_err());
        let start = epoch("55321.25");
        // 1e9 days are 8.64e13 s.
        for (seconds, is_refused) in [
            ([8.6e13, 0.0], false),
            ([8.7e13, 0.0], true),
            ([-8.7e13, 0.0], true),
            ([8.6e13, 8.6e13], true),
            ([9.0e13, -8.0e13], false),
        ] {
            assert_eq!(start.after(seconds).is_err(), is_refused, "{seconds:?}");
        }
        let later = start.after([9.0e12, -8.0e12]).unwrap();
        let [high, low] = later.seconds_since(&start);
        assert!(high == 1e12 && low.abs() < 1e-11, "{high} {low:e}");
    }

    /// The day changes correctly at midnight. A change below the rounding of the fraction stays on its side of midnight or has no
    /// effect.
    #[test]
    fn a_fraction_is_below_one() {
        for (start, days, expected) in [
            ("5.0", [-1e-20, 0.0], ("5.0", 0.0)),
            ("5.5", [-0.5, -1e-20], ("5.0", 0.0)),
            ("5.75", [0.25, 0.0], ("6.0", 0.0)),
            ("5.75", [0.25, -1.5e-16], ("5.75", 0.25)),
            ("5.75", [-0.875, 0.0], ("4.875", 0.0)),
            ("5.75", [2.5, 1e-17], ("8.25", 0.0)),
            ("5.0", [1.0, -1e-20], ("6.0", 0.0)),
            ("5.0", [-1.0, -1e-20], ("4.0", 0.0)),
        ] {
            let found = epoch(start).with_days(DoubleDouble::from(days));
            let (day, off) = (epoch(expected.0).day(), found.fraction() - epoch(expected.0).fraction() - expected.1);
            assert!(found.day() == day && off.abs() < 2e-16 && found.fraction() < 1.0, "{start} {days:?}: {found:?}");
        }
    }

    #[test]
    fn a_midnight_less_a_picosecond_is_written_as_that_midnight() {
        for (seconds, text) in [([86_400.0, -1e-12], "6.0"), ([-86_400.0, -1e-12], "4.0")] {
            assert_eq!(epoch("5.0").after(seconds).expect("a date").to_string(), text);
        }
    }

    #[test]
    fn what_is_no_date_is_refused() {
        for text in ["", ".5", "5.", "-1", "+5", "1e5", "nan", "inf", "5.5.5", "10000001", "99999999999999999999", " 1"]
        {
            assert!(text.parse::<Epoch>().is_err(), "{text}");
        }
        assert!(matches!("5.".parse::<Epoch>(), Err(Error::Unsupported { what: "epoch (MJD)", .. })));
        assert!(Epoch::new(0, f64::NAN).is_err() && Epoch::new(0, -0.5).is_err());
        assert!(Epoch::new(i64::MAX, -9.223_372_036_854_776e18).is_err());
        for seconds in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
            assert!(epoch("0.5").after([seconds, 0.0]).is_err(), "{seconds}");
        }
        assert_eq!(Epoch::new(5, -0.25).expect("a date"), Epoch::new(4, 0.75).expect("a date"));
    }

    #[test]
    fn ten_picoseconds_are_kept_over_decades() {
        let start = epoch("47000.3712345678901234");
        for seconds in
            [[0.0, 0.0], [1e-11, 0.0], [6.3e8, 1.25e-9], [-4e8, 3e-9], [0.001_557, 1e-20], [43_199.999_999_999_99, 0.0]]
        {
            let there = start.after(seconds).expect("near");
            let off = DoubleDouble::from(there.seconds_since(&start)) - seconds.into();
            assert!(off.high.abs() < 1e-11, "{seconds:?}: {off:?}");
            assert!((0.0..1.0).contains(&there.fraction()));
            let back = there.after([-seconds[0], -seconds[1]]).expect("near").seconds_since(&start);
            assert!(back[0].abs() < 2e-11, "{seconds:?}: {back:?}");
        }
        assert_eq!(epoch("1.0").after([-172_800.0, 0.0]).expect("near").to_string(), "-1.0");
        assert_eq!(epoch("1.25").after([-172_800.0, 0.0]).expect("near").to_string(), "-0.75");
        // A day before zero, and a fraction of 1e-17 that no number beside one has.
        assert_eq!(epoch("0.00000000000000001").after([-86_400.0, 0.0]).expect("near").to_string(), "-1.0");
    }

    #[test]
    fn what_is_beyond_a_whole_day_is_kept() {
        let almost = Epoch { day: 7, fraction: 1.0 - f64::EPSILON / 2.0 };
        // 2^-60 day more than the time up to midnight.
        let beyond = 0.5_f64.powi(60);
        let later = almost.with_days(DoubleDouble::from(f64::EPSILON / 2.0 + beyond));
        assert_eq!(later, Epoch { day: 8, fraction: beyond });
        let before = almost.with_days(DoubleDouble::from(f64::EPSILON / 2.0) - beyond.into());
        assert_eq!(before, Epoch { day: 8, fraction: 0.0 });
    }
}
