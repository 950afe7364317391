//! Bytes read as a choice of cases and as numbers of every kind.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Debug;
use std::hint::black_box;

/// Bytes read from the front; beyond their end there are zeros.
pub(super) struct Bytes<'a> {
    rest: &'a [u8],
    /// Whether all numbers so far are finite, and neither so large nor so small that their powers overflow or vanish.
    pub(super) moderate: bool,
}

/// Critical numbers of formulas: zeros, signs, ends of ranges, poles, NaN and infinities.
const SPECIAL: [[f64; 8]; 4] = [
    [0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE],
    [5e-324, -5e-324, f64::MAX, f64::MIN, f64::EPSILON, 1.0 - f64::EPSILON / 2.0, 1.0 + f64::EPSILON, PI],
    [FRAC_PI_2, TAU, -PI, 0.577_350_269_189_625_8, 1.0 / 3.0, 0.5, 2.0, 1e-8],
    [1e-16, 1e-160, 1e160, 1e15, 1e-13, 1e300, 1.1, 0.02],
];

impl<'a> Bytes<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, moderate: true }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub(super) fn byte(&mut self) -> u8 {
        let (first, rest) = self.rest.split_first().unwrap_or((&0, &[]));
        self.rest = rest;
        *first
    }

    /// A whole number below `end`, from two bytes.
    pub(super) fn below(&mut self, end: usize) -> usize {
        (usize::from(self.byte()) << 8 | usize::from(self.byte())) % end.max(1)
    }

    /// A special number, a number with arbitrary bits, or one of ordinary size with its sign.
    pub(super) fn number(&mut self) -> f64 {
        let number = match self.byte() {
            kind @ 0..64 => SPECIAL.as_flattened()[usize::from(kind) % 32],
            64..96 => f64::from_bits(u64::from_le_bytes(std::array::from_fn(|_| self.byte()))),
            96..128 => self.ordinary() * 10f64.powi(i32::from(self.byte() as i8)),
            _ => self.ordinary(),
        };
        self.moderate &= number == 0.0 || (1e-15..=1e15).contains(&number.abs());
        number
    }

    /// A number from -4 to 4.
    fn ordinary(&mut self) -> f64 {
        f64::from(u16::from_le_bytes([self.byte(), self.byte()]) as i16) / 8192.0
    }

    /// A number as in scenes, mostly from -4 to 4.
    pub(super) fn usual(&mut self) -> f64 {
        if self.byte() < 32 { self.number() } else { self.ordinary() }
    }
}

/// Panics if a result for moderate numbers has one that is not finite.
#[track_caller]
pub(super) fn finite<T: Debug>(moderate: bool, result: Result<T, twofold::Error>) {
    if let (true, Ok(value)) = (moderate, black_box(result)) {
        let text = format!("{value:?}");
        let is_finite = |word: &str| !["inf", "NaN"].contains(&word);
        assert!(text.split(|c: char| !c.is_alphanumeric()).all(is_finite), "a number is not finite: {text}");
    }
}
