//! Tables of Fourier coefficients, and their sums.

use super::fourier::Pair;
use crate::numerics::four_lanes::FourLanes;

/// Cosine, cosine, sine and sine of a multiple of an angle.
pub(super) type Turn = [f64; 4];

/// Cosines and sines of all multiples of an angle, from zero on.
#[inline(always)]
pub(super) fn fill_with_turns<F: FourLanes>(four: F, turns: &mut [Turn], (sin, cos): (f64, f64)) {
    for k in 0..turns.len() {
        let turn = match k {
            0 => four.load(&[1.0, 1.0, 0.0, 0.0]),
            1 => four.load(&[cos, cos, sin, sin]),
            _ => {
                // In as few steps after one another as there are binary digits.
                let (near, [c, _, s, _]) = (turns[k - k / 2], turns[k / 2]);
                let across = four.load(&[-near[2], -near[2], near[0], near[0]]);
                four.multiply_add(across, four.all(s), four.multiply_add(four.load(&near), four.all(c), four.all(0.0)))
            }
        };
        turns[k] = four.store(turn);
    }
}

/// Fourier coefficients of six functions on the torus. Half a turn of the second angle changes the sign of the first four, which have `k = 1, 3, ...`, and not of
/// the others, with `k = 0, 2, ...`. The first two are even under a reflection in the plane, the next two odd; the last two are whichever is asked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// For each multiple `j` of the first angle the number of multiples of the second of the first four functions, and of the last two.
    pub(super) counts: Vec<[usize; 2]>,
    /// Of the first four functions, those with `cos k theta_2` and with `sin k theta_2`.
    pub(super) changing: Vec<[[f64; 4]; 2]>,
    /// Of the last two functions, those with `cos k theta_2` and then those with `sin k theta_2`.
    pub(super) others: Vec<[f64; 4]>,
}

/// Values of the six functions, the last two taken as even and as odd ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Values {
    pub(super) changing: [f64; 4],
    pub(super) even: [f64; 2],
    pub(super) odd: [f64; 2],
}

/// How many coefficients of some functions are kept for a multiple of the first angle, and the sum of the others.
fn kept(functions: &[Vec<Vec<Pair>>], j: usize, smallest: f64) -> (usize, f64) {
    let largest =
        |i: usize| functions.iter().map(|table| table[j][i][0].abs().max(table[j][i][1].abs())).fold(0.0, f64::max);
    let length = functions[0][j].len();
    let count = (0..length).rev().find(|&i| largest(i) > smallest).map_or(0, |i| i + 1);
    (count, (count..length).map(largest).sum())
}

impl Table {
    /// The table of six functions by their coefficients `[j][i]`, `k = 2 i` or `2 i + 1`, without the smallest, of which the sum is at most a tolerance (where rounding
    /// lets it); and that sum.
    pub(super) fn within(functions: &[Vec<Vec<Pair>>; 6], tolerance: f64) -> (Self, f64) {
        let left = |smallest: f64| -> f64 {
            let of = |j: usize| kept(&functions[..4], j, smallest).1 + kept(&functions[4..], j, smallest).1;
            (0..functions[0].len()).map(of).sum()
        };
        let mut smallest = 0.1 * tolerance;
        while left(smallest) > tolerance && smallest > 1e-3 * tolerance {
            smallest *= 0.5;
        }
        Self::without_smallest(functions, smallest)
    }

    /// The table without coefficients so small that omitting them does not show, and the sum of these.
    fn without_smallest(functions: &[Vec<Vec<Pair>>; 6], smallest: f64) -> (Self, f64) {
        let mut left = 0.0;
        let mut table = Self::default();
        for j in 0..functions[0].len() {
            let mut kept = |functions: &[Vec<Vec<Pair>>]| {
                let (count, omitted) = kept(functions, j, smallest);
                left += omitted;
                count
            };
            let counts = [kept(&functions[..4]), kept(&functions[4..])];
            table.counts.push(counts);
            let of = |function: usize, i: usize, part: usize| functions[function][j][i][part];
            table.changing.extend((0..counts[0]).map(|i| [0, 1].map(|part| [0, 1, 2, 3].map(|f| of(f, i, part)))));
            table.others.extend((0..counts[1]).map(|i| [of(4, i, 0), of(5, i, 0), of(4, i, 1), of(5, i, 1)]));
        }
        while table.counts.last() == Some(&[0, 0]) {
            table.counts.pop();
        }
        (table, left)
    }

    /// How many multiples of each angle are needed, zero among them.
    pub(super) fn multiples(&self) -> [usize; 2] {
        [self.counts.len(), self.counts.iter().map(|[changing, others]| 2 * changing.max(others)).max().unwrap_or(0)]
    }

    /// Number of pairs of frequencies.
    pub(super) fn len(&self) -> usize {
        self.changing.len() + self.others.len()
    }

    /// Multiplies the second, the fourth and the sixth function.
    pub(super) fn scale_every_other(&mut self, factor: f64) {
        let scale = |row: &mut [f64; 4]| {
            row[1] *= factor;
            row[3] *= factor;
        };
        self.changing.iter_mut().flatten().for_each(scale);
        self.others.iter_mut().for_each(scale);
    }

    /// The sums for turns of both angles.
    #[inline(always)]
    pub(super) fn at<F: FourLanes>(&self, four: F, first: &[Turn], second: &[Turn]) -> Values {
        let (mut changing, mut others) = (self.changing.as_slice(), self.others.as_slice());
        let zero = four.all(0.0);
        let (mut sum, mut even, mut odd) = (zero, zero, zero);
        for (counts, turn) in self.counts.iter().zip(first) {
            let [cos, _, sin, _] = *turn;
            let (turn, crossed) = (four.load(turn), four.load(&[sin, sin, cos, cos]));
            let (row, rest) = changing.split_at(counts[0]);
            changing = rest;
            let (mut with_cos, mut with_sin) = (zero, zero);
            for ([a, b], [c, _, s, _]) in row.iter().zip(second.iter().skip(1).step_by(2)) {
                with_cos = four.multiply_add(four.load(a), four.all(*c), with_cos);
                with_sin = four.multiply_add(four.load(b), four.all(*s), with_sin);
            }
            sum = four.multiply_add(with_cos, turn, sum);
            sum = four.multiply_add(with_sin, crossed, sum);
            let (row, rest) = others.split_at(counts[1]);
            others = rest;
            let mut both = zero;
            for (coefficients, turn) in row.iter().zip(second.iter().step_by(2)) {
                both = four.multiply_add(four.load(coefficients), four.load(turn), both);
            }
            even = four.multiply_add(both, turn, even);
            odd = four.multiply_add(both, crossed, odd);
        }
        let [even, odd] = [even, odd].map(|lanes| {
            let [a, b, c, d] = four.store(lanes);
            [a + c, b + d]
        });
        Values { changing: four.store(sum), even, odd }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::arithmetic::plain;
    use crate::numerics::fused::{detect_fused, run_fused};

    #[test]
    fn turns_are_those_of_multiples() {
        let mut turns = [[0.0; 4]; 40];
        fill_with_turns(plain(), &mut turns, 0.7_f64.sin_cos());
        for (k, turn) in turns.iter().enumerate() {
            let (sin, cos) = (0.7 * k as f64).sin_cos();
            for (found, expected) in turn.iter().zip([cos, cos, sin, sin]) {
                assert!((found - expected).abs() < 1e-14, "{k}: {turn:?}");
            }
        }
    }

    /// Six functions with coefficients that differ, summed term by term, by vectors and one by one.
    #[test]
    fn sums_are_those_of_all_terms() {
        let size = |f: usize, j: usize, k: usize, part: usize| 1.0 / (1.0 + (f + 2 * j + 3 * k + 5 * part) as f64);
        let functions: [Vec<Vec<Pair>>; 6] = core::array::from_fn(|f| {
            let parity = usize::from(f < 4);
            let row = |j: usize| (0..4).map(|i| [0, 1].map(|part| size(f, j, 2 * i + parity, part))).collect();
            (0..5).map(row).collect()
        });
        let (table, left) = Table::without_smallest(&functions, 0.0);
        assert_eq!((left, table.multiples(), table.len()), (0.0, [5, 8], 40));
        let (a, b) = (0.4_f64, 1.1_f64);
        let of = |f: usize, is_even: bool| {
            let parity = usize::from(f < 4);
            let terms = (0..5).flat_map(|j| (0..4).map(move |i| (j, 2 * i + parity)));
            let each = terms.map(|(j, k)| {
                let ((sj, cj), (sk, ck)) = ((j as f64 * a).sin_cos(), (k as f64 * b).sin_cos());
                let (first, second) = if is_even { (cj * ck, sj * sk) } else { (sj * ck, cj * sk) };
                size(f, j, k, 0) * first + size(f, j, k, 1) * second
            });
            each.sum::<f64>()
        };
        let expected = Values {
            changing: [of(0, true), of(1, true), of(2, false), of(3, false)],
            even: [of(4, true), of(5, true)],
            odd: [of(4, false), of(5, false)],
        };
        let (mut first, mut second) = ([[0.0; 4]; 5], [[0.0; 4]; 8]);
        fill_with_turns(plain(), &mut first, a.sin_cos());
        fill_with_turns(plain(), &mut second, b.sin_cos());
        let near = |found: Values| {
            let pairs = found.changing.into_iter().zip(expected.changing);
            let pairs = pairs.chain(found.even.into_iter().zip(expected.even));
            let off = pairs.chain(found.odd.into_iter().zip(expected.odd)).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-14, "{found:?} {expected:?}");
        };
        near(table.at(plain(), &first, &second));
        if let Some(fused) = detect_fused() {
            near(run_fused(fused, || table.at(fused, &first, &second)));
        }
    }

    #[test]
    fn what_is_left_out_is_added_up() {
        let fall = |f: usize, j: usize, k: usize| 10f64.powi(-((j + k) as i32)) / (1 + f) as f64;
        let functions: [Vec<Vec<Pair>>; 6] = core::array::from_fn(|f| {
            let parity = usize::from(f < 4);
            (0..4).map(|j| (0..4).map(|i| [0.0, fall(f, j, 2 * i + parity)]).collect()).collect()
        });
        let (mut table, left) = Table::without_smallest(&functions, 1e-4);
        // Of the first four functions the first is the largest, of the others the fifth.
        let small = |size: &f64| *size <= 1e-4;
        let terms = |parity: usize| (0..4).flat_map(move |j| (0..4).map(move |i| (j, 2 * i + parity)));
        let odd: f64 = terms(1).map(|(j, k)| fall(0, j, k)).filter(small).sum();
        let even: f64 = terms(0).map(|(j, k)| fall(4, j, k)).filter(small).sum();
        assert!((left / (odd + even) - 1.0).abs() < 1e-12, "{left:e} {odd:e} {even:e}");
        assert_eq!(table.counts, [[2, 2], [1, 2], [1, 1], [0, 1]]);
        table.scale_every_other(3.0);
        assert_eq!(table.changing[0], [[0.0; 4], [0.1, 3.0 * fall(1, 0, 1), fall(2, 0, 1), 3.0 * fall(3, 0, 1)]]);
        assert_eq!(table.others[0], [0.0, 0.0, fall(4, 0, 0), 3.0 * fall(5, 0, 0)]);
    }
}
