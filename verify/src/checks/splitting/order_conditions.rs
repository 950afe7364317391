//! Order conditions of the splitting schemes, in the free Lie algebra of the two flows.

use crate::prelude::*;
use twofold::propagation::splitting::{Ends, SCHEMES, Scheme};

/// Maximum length of words: one less than the highest order, 10.
const LENGTH: usize = 9;

/// A series in words of two letters up to [`LENGTH`]. The coefficient of the word with the bits `w` (first letter highest, zero is A) and
/// length `n` has the index `2^n + w`.
#[derive(Clone)]
struct Series(Vec<f64>);

impl Series {
    fn zero() -> Self {
        Self(vec![0.0; 2 << LENGTH])
    }

    fn letter(b: bool) -> Self {
        let mut series = Self::zero();
        series.0[2 + usize::from(b)] = 1.0;
        series
    }

    fn plus(&self, other: &Self, factor: f64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(x, y)| x + factor * y).collect())
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = Self::zero();
        for length in 0..=LENGTH {
            for word in 0..1 << length {
                for tail in 0..=length {
                    let (left, right) = (word >> tail, word & ((1 << tail) - 1));
                    product.0[(1 << length) + word] +=
                        self.0[(1 << (length - tail)) + left] * other.0[(1 << tail) + right];
                }
            }
        }
        product
    }

    fn bracket(&self, other: &Self) -> Self {
        self.times(other).plus(&other.times(self), -1.0)
    }

    /// `sum_k power^k / weight(k)`, for a series without constant term.
    fn sum_of_powers(&self, weight: impl Fn(usize) -> f64) -> Self {
        let mut power = Self::zero();
        power.0[1] = 1.0;
        let mut sum = Self::zero();
        for k in 0..=LENGTH {
            sum = sum.plus(&power, weight(k));
            power = power.times(self);
        }
        sum
    }

    fn exp(&self) -> Self {
        let mut factorial = [1.0; LENGTH + 1];
        (1..=LENGTH).for_each(|k| factorial[k] = factorial[k - 1] * k as f64);
        self.sum_of_powers(|k| 1.0 / factorial[k])
    }

    fn ln(&self) -> Self {
        let mut rest = self.clone();
        rest.0[1] -= 1.0;
        rest.sum_of_powers(|k| if k == 0 { 0.0 } else { (if k % 2 == 1 { 1.0 } else { -1.0 }) / k as f64 })
    }

    /// The part with a given length and a given number of letters B.
    fn part(&self, length: usize, kicks: u32) -> Vec<f64> {
        (0..1_usize << length)
            .filter(|word| word.count_ones() == kicks)
            .map(|word| self.0[(1 << length) + word])
            .collect()
    }
}

fn step(scheme: &Scheme) -> Series {
    let (a, b) = (Series::letter(false), Series::letter(true));
    let gradient = b.bracket(&a.bracket(&b));
    let turn = |i: usize| Series::zero().plus(&a, scheme.rotations[i]).exp();
    let kick = |i: usize| {
        let weight = scheme.gradients.get(i).copied().unwrap_or(0.0);
        Series::zero().plus(&b, scheme.kicks[i]).plus(&gradient, weight).exp()
    };
    let mut product = match scheme.ends {
        Ends::Rotations => turn(0),
        Ends::Kicks => kick(0),
    };
    for i in 0..scheme.stages() {
        product = match scheme.ends {
            Ends::Rotations => product.times(&kick(i)).times(&turn(i + 1)),
            Ends::Kicks => product.times(&turn(i)).times(&kick(i + 1)),
        };
    }
    product
}

/// The ideal of `[B,[B,[B,A]]]`, which vanishes for these flows: its elements as nested brackets.
fn vanishing() -> Vec<Series> {
    let (a, b) = (Series::letter(false), Series::letter(true));
    let first = b.bracket(&b.bracket(&b.bracket(&a)));
    let mut all = vec![first];
    let mut from = 0;
    for _ in 4..7 {
        let until = all.len();
        for i in from..until {
            all.push(a.bracket(&all[i]));
            all.push(b.bracket(&all[i]));
        }
        from = until;
    }
    all
}

/// The part of `vector` outside the span of `others` (Gram-Schmidt).
fn outside(mut vector: Vec<f64>, others: &[Vec<f64>]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let remove = |v: &mut Vec<f64>, basis: &[Vec<f64>]| {
        for e in basis {
            let along = dot(v, e);
            v.iter_mut().zip(e).for_each(|(x, y)| *x -= along * y);
        }
    };
    for other in others {
        let (mut rest, size) = (other.clone(), dot(other, other).sqrt());
        remove(&mut rest, &basis);
        remove(&mut rest, &basis);
        let length = dot(&rest, &rest).sqrt();
        if length > 1e-9 * size && size > 0.0 {
            basis.push(rest.iter().map(|x| x / length).collect());
        }
    }
    remove(&mut vector, &basis);
    vector
}

/// The largest coefficient of the logarithm of a step minus A + B, among the terms that vanish according to the claimed orders.
pub(super) fn residuals() -> Result<Measured, String> {
    let ideal = vanishing();
    let words: Vec<_> = (1..=LENGTH).flat_map(|length| (0..=length as u32).map(move |kicks| (length, kicks))).collect();
    worst_of(SCHEMES, |scheme| {
        let log = step(scheme).ln();
        let claimed = |kicks: u32| scheme.orders[(kicks.max(1) as usize - 1).min(2)] as usize;
        worst_of(words.iter().filter(|(length, kicks)| *length <= claimed(*kicks)), |&&(length, kicks)| {
            let mut part = log.part(length, kicks);
            if length == 1 {
                part[0] -= 1.0;
            }
            let others: Vec<_> = ideal.iter().map(|series| series.part(length, kicks)).collect();
            let rest = if kicks >= 3 { outside(part, &others) } else { part };
            Ok(largest(rest.iter().map(|x| x.abs())))
        })
    })
}
