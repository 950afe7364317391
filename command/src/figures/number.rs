//! Numbers in captions, with markup.

use super::axes::{power_of_ten, signed};
use twofold_scene::significant::rounded;

/// Six significant digits without trailing zeros.
pub(super) fn number(x: f64) -> String {
    significant(x, 6)
}

/// A number compared with others of the size `scale`: below 1e-12 of that it is the rounding of a zero.
pub(super) fn beside(x: f64, scale: f64) -> String {
    if x.abs() <= 1e-12 * scale { "0".into() } else { number(x) }
}

/// Some significant digits without trailing zeros; very large and small numbers with a power of ten, `2.5 × 10^{−3}`.
pub(super) fn significant(x: f64, digits: usize) -> String {
    let (text, power) = rounded(x, digits, -3..=5);
    let trimmed = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    match power {
        None => signed(trimmed),
        Some(power) => format!("{} × {}", signed(trimmed), power_of_ten(power)),
    }
}

/// Numbers with a relative difference up to this differ only by rounding: it is far above the rounding of a motion over the span of a figure.
pub(super) const ALIKE: f64 = 1e-11;

/// The range of numbers with a nearly common value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Spread {
    /// The range of numbers; `None` without any.
    pub(super) fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        (low <= high).then_some(Self { low, high })
    }

    /// The spread relative to the larger end.
    pub(super) fn relative(self) -> f64 {
        let size = self.high.max(-self.low);
        if size == 0.0 { 0.0 } else { (self.high - self.low) / size }
    }

    /// Number of significant digits that the numbers have in common, plus two that distinguish them.
    fn digits(self) -> usize {
        let spread = self.relative().max(ALIKE);
        (2.0 - spread.log10().floor()).max(3.0) as usize
    }

    /// A common value to subtract before drawing, if the numbers differ by more than rounding but by too little for an axis.
    pub(super) fn reference(self) -> Option<f64> {
        let drawn_apart = (ALIKE..1e-3).contains(&self.relative());
        drawn_apart
            .then(|| format!("{:.*e}", self.digits() - 3, 0.5 * (self.low + self.high)).parse().expect("a number"))
    }

    /// `from 3.92 to 5.60 s`, or `0.40504331743 s within 10^{−11} of that`; `unit` begins with a space.
    pub(super) fn in_words(self, unit: &str) -> String {
        let digits = self.digits();
        if self.relative() < ALIKE {
            return format!("{}{unit} within 10^{{−11}} of that", significant(self.high, digits - 2));
        }
        format!("from {} to {}{unit}", significant(self.low, digits), significant(self.high, digits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_kept_and_zeros_are_not() {
        for (x, text) in [
            (0.1, "0.1"),
            (1.0, "1"),
            (-0.04, "−0.04"),
            (2.4384e-15, "2.4384 × 10^{−15}"),
            (9.388_869_9e-9, "9.38887 × 10^{−9}"),
            (641.928_233_3, "641.928"),
            (12_345_678.0, "1.23457 × 10^{7}"),
            (0.999_999_99, "1"),
            (999_999.99, "1 × 10^{6}"),
            (0.0, "0"),
            (0.001_234_5, "0.0012345"),
            (0.000_123_45, "1.2345 × 10^{−4}"),
        ] {
            assert_eq!(number(x), text);
        }
        assert_eq!([beside(3e-17, 1.0), beside(3e-17, 1e-16)], ["0", "3 × 10^{−17}"]);
    }

    #[test]
    fn a_spread_is_told_with_digits_that_differ() {
        let spread = |low, high| Spread { low, high };
        assert_eq!(spread(3.917, 5.604).in_words(" s"), "from 3.92 to 5.6 s");
        assert_eq!(spread(0.001_557_806, 0.001_557_807).in_words(""), "from 0.001557806 to 0.001557807");
        assert_eq!(
            spread(0.405_043_317_428_1, 0.405_043_317_428_1).in_words(" s"),
            "0.40504331743 s within 10^{−11} of that"
        );
        assert_eq!(Spread::of([]), None);
        assert_eq!((spread(1.0, 2.0).reference(), spread(1.0, 1.0).reference()), (None, None));
        let near = spread(0.013_316_771_2, 0.013_316_777_4);
        let reference = near.reference().unwrap();
        // The printed value is the subtracted one.
        assert_eq!(significant(reference, 15), "0.01331677");
        assert!((reference - near.low).abs() < 2.0 * (near.high - near.low));
    }

    #[test]
    fn negative_numbers_are_spread_as_positive_ones() {
        let of = |low, high| Spread { low, high };
        for (low, high, part) in [(-4.0, -3.0, 0.25), (3.0, 4.0, 0.25), (-4.0, 1.0, 1.25), (-1.0, 4.0, 1.25)] {
            assert_eq!(of(low, high).relative(), part);
        }
        assert_eq!(of(-5.604, -3.917).in_words(" s"), "from −5.6 to −3.92 s");
        let same = -0.405_043_317_428_1;
        assert_eq!(of(same, same).in_words(" s"), "−0.40504331743 s within 10^{−11} of that");
    }
}
