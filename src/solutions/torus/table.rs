//! Tables of Fourier coefficients, and their sums.

use super::fourier::Pair;
use crate::numerics::four_lanes::FourLanes;

/// Cosines and sines of multiples of an angle from zero on, in blocks of four.
pub(super) struct Multiples<'a> {
    cos: &'a [[f64; 4]],
    sin: &'a [[f64; 4]],
}

impl<'a> Multiples<'a> {
    /// Computes them, half of a slice the cosines and half the sines.
    #[inline(always)]
    pub(super) fn fill<F: FourLanes>(four: F, blocks: &'a mut [[f64; 4]], (sin, cos): (f64, f64)) -> Self {
        let across = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, b * c + a * d];
        let first = [cos, sin];
        let second = across(first, first);
        let (third, fourth) = (across(second, first), across(second, second));
        let (of_cos, of_sin) = blocks.split_at_mut(blocks.len() / 2);
        for i in 0..of_cos.len() {
            if i == 0 {
                of_cos[0] = [1.0, first[0], second[0], third[0]];
                of_sin[0] = [0.0, first[1], second[1], third[1]];
                continue;
            }
            // In as few steps after one another as there are binary digits.
            let by = i.div_ceil(2);
            let [c, s] = if i == 1 { fourth } else { [of_cos[by][0], of_sin[by][0]] };
            let (near_cos, near_sin) = (four.load(&of_cos[i - by]), four.load(&of_sin[i - by]));
            let (c, s, minus_s) = (four.all(c), four.all(s), four.all(-s));
            let zero = four.all(0.0);
            of_cos[i] = four.store(four.multiply_add(near_cos, c, four.multiply_add(near_sin, minus_s, zero)));
            of_sin[i] = four.store(four.multiply_add(near_sin, c, four.multiply_add(near_cos, s, zero)));
        }
        Self { cos: of_cos, sin: of_sin }
    }
}

/// Fourier coefficients of six functions on the torus. Half a turn of the second angle changes the sign of the first four, which have `k = 1, 3, ...`, and not of
/// the others, with `k = 0, 2, ...`. The first two are even under a reflection in the plane, the next two odd; the last two are whichever is asked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// For every four multiples `j` of the first angle how many `i` are kept: `k = 2 i` and `2 i + 1`.
    counts: Vec<usize>,
    /// For each of these `i` the coefficients of the four `j`.
    coefficients: Vec<[Coefficients; 4]>,
}

/// Coefficients of the six functions for one `j` and one `i`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Coefficients {
    /// Of the first four functions, those with `cos (2 i + 1) theta_2` and with `sin (2 i + 1) theta_2`.
    changing: [[f64; 4]; 2],
    /// Of the last two functions, those with `cos 2 i theta_2` and then those with `sin 2 i theta_2`.
    others: [f64; 4],
}

/// Values of the six functions, the last two taken as even and as odd ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Values {
    pub(super) changing: [f64; 4],
    pub(super) even: [f64; 2],
    pub(super) odd: [f64; 2],
}

/// The coefficients of a function for `j` and `i`; zero beyond its last.
fn pair(table: &[Vec<Pair>], j: usize, i: usize) -> Pair {
    table.get(j).and_then(|row| row.get(i)).copied().unwrap_or_default()
}

/// How many coefficients of functions with the same pairs of frequencies are above the smallest for a multiple `j` of the first angle, and the sum of those behind them.
fn above(functions: &[Vec<Vec<Pair>>], j: usize, smallest: f64) -> (usize, f64) {
    let largest =
        |i: usize| functions.iter().flat_map(|table| pair(table, j, i)).fold(0.0, |most: f64, x| most.max(x.abs()));
    let length = functions[0][j].len();
    let count = (0..length).rev().find(|&i| largest(i) > smallest).map_or(0, |i| i + 1);
    (count, (count..length).map(largest).sum())
}

impl Table {
    /// The table of six functions by their coefficients `[j][i]`, `k = 2 i` or `2 i + 1`, without the smallest, of which the sum is at most a tolerance (where rounding
    /// lets it); and that sum.
    pub(super) fn within(functions: &[Vec<Vec<Pair>>; 6], tolerance: f64) -> (Self, f64) {
        let left = |smallest: f64| -> f64 {
            let of = |j: usize| above(&functions[..4], j, smallest).1 + above(&functions[4..], j, smallest).1;
            (0..functions[0].len()).map(of).sum()
        };
        let mut smallest = 0.1 * tolerance;
        while left(smallest) > tolerance && smallest > 1e-3 * tolerance {
            smallest *= 0.5;
        }
        Self::without_smallest(functions, smallest)
    }

    /// The table without what is behind the coefficients above the smallest, and the sum of that. Of it the table keeps what comes before the longest of four rows; for a
    /// row that ends with the grid it stands for what comes behind.
    fn without_smallest(functions: &[Vec<Vec<Pair>>; 6], smallest: f64) -> (Self, f64) {
        let mut left = 0.0;
        let mut table = Self::default();
        let of = |j: usize, i: usize| {
            let of = |function: usize, part: usize| pair(&functions[function], j, i)[part];
            Coefficients {
                changing: [0, 1].map(|part| [0, 1, 2, 3].map(|function| of(function, part))),
                others: [of(4, 0), of(5, 0), of(4, 1), of(5, 1)],
            }
        };
        let length = functions[0].len();
        for first in (0..length).step_by(4) {
            let rows =
                (first..length.min(first + 4)).flat_map(|j| [&functions[..4], &functions[4..]].map(|of| (of, j)));
            let (counts, omitted): (Vec<_>, Vec<_>) = rows.map(|(of, j)| above(of, j, smallest)).unzip();
            let count = counts.into_iter().max().unwrap_or(0);
            left += omitted.iter().sum::<f64>();
            table.counts.push(count);
            table.coefficients.extend((0..count).map(|i| [0, 1, 2, 3].map(|row| of(first + row, i))));
        }
        while table.counts.last() == Some(&0) {
            table.counts.pop();
        }
        (table, left)
    }

    /// How many blocks of four multiples of each angle are needed.
    pub(super) fn blocks(&self) -> [usize; 2] {
        [self.counts.len(), self.counts.iter().map(|count| count.div_ceil(2)).max().unwrap_or(0)]
    }

    /// Number of pairs of frequencies.
    pub(super) fn len(&self) -> usize {
        8 * self.coefficients.len()
    }

    /// Multiplies the second, the fourth and the sixth function.
    pub(super) fn scale_every_other(&mut self, factor: f64) {
        for Coefficients { changing: [a, b], others } in self.coefficients.iter_mut().flatten() {
            for row in [a, b, others] {
                row[1] *= factor;
                row[3] *= factor;
            }
        }
    }

    /// The sums for multiples of both angles.
    #[inline(always)]
    pub(super) fn at<F: FourLanes>(&self, four: F, first: &Multiples<'_>, second: &Multiples<'_>) -> Values {
        let mut coefficients = self.coefficients.as_slice();
        let zero = four.all(0.0);
        let (mut sum, mut even, mut odd) = (zero, zero, zero);
        let [cos_k, sin_k] = [second.cos, second.sin].map(|multiples| multiples.as_flattened().as_chunks::<2>().0);
        for ((&count, cos), sin) in self.counts.iter().zip(first.cos).zip(first.sin) {
            let (block, rest) = coefficients.split_at(count);
            coefficients = rest;
            // Four rows at once, so that no sum waits for the one before.
            let mut rows = [[zero; 3]; 4];
            for ((block, [even_cos, odd_cos]), [even_sin, odd_sin]) in block.iter().zip(cos_k).zip(sin_k) {
                let (cos, sin) = (four.all(*odd_cos), four.all(*odd_sin));
                let both = four.load(&[*even_cos, *even_cos, *even_sin, *even_sin]);
                for (row, Coefficients { changing: [a, b], others }) in rows.iter_mut().zip(block) {
                    row[0] = four.multiply_add(four.load(a), cos, row[0]);
                    row[1] = four.multiply_add(four.load(b), sin, row[1]);
                    row[2] = four.multiply_add(four.load(others), both, row[2]);
                }
            }
            for (([with_cos, with_sin, both], c), s) in rows.into_iter().zip(cos).zip(sin) {
                let (turn, crossed) = (four.load(&[*c, *c, *s, *s]), four.load(&[*s, *s, *c, *c]));
                sum = four.multiply_add(with_cos, turn, sum);
                sum = four.multiply_add(with_sin, crossed, sum);
                even = four.multiply_add(both, turn, even);
                odd = four.multiply_add(both, crossed, odd);
            }
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
    fn multiples_are_those_of_the_angle() {
        let mut blocks = [[0.0; 4]; 20];
        let found = Multiples::fill(plain(), &mut blocks, 0.7_f64.sin_cos());
        let pairs = found.cos.as_flattened().iter().zip(found.sin.as_flattened());
        assert_eq!(pairs.len(), 40);
        for (k, (cos, sin)) in pairs.enumerate() {
            let expected = (0.7 * k as f64).sin_cos();
            assert!((sin - expected.0).abs() < 1e-14 && (cos - expected.1).abs() < 1e-14, "{k}: {cos} {sin}");
        }
    }

    /// Functions with even multiples may have one more.
    #[test]
    fn the_last_even_multiple_is_kept() {
        let functions: [Vec<Vec<Pair>>; 6] =
            core::array::from_fn(|f| vec![vec![[1.0, 1.0]; if f < 4 { 2 } else { 3 }]]);
        let (table, left) = Table::without_smallest(&functions, 0.1);
        assert_eq!((table.counts.as_slice(), left), (&[3][..], 0.0));
        assert_eq!((table.coefficients[2][0].changing, table.coefficients[2][0].others), ([[0.0; 4]; 2], [1.0; 4]));
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
        assert_eq!((left, table.blocks(), table.len()), (0.0, [2, 2], 64));
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
        let (mut first, mut second) = ([[0.0; 4]; 4], [[0.0; 4]; 4]);
        let first = Multiples::fill(plain(), &mut first, a.sin_cos());
        let second = Multiples::fill(plain(), &mut second, b.sin_cos());
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
            (0..6).map(|j| (0..4).map(|i| [0.0, fall(f, j, 2 * i + parity)]).collect()).collect()
        });
        // The longest of each four rows is their first.
        let (mut table, left) = Table::without_smallest(&functions, 1e-5);
        assert_eq!((table.counts.as_slice(), table.blocks()), (&[3, 1][..], [2, 2]));
        // Of the first four functions the first is the largest, of the others the fifth.
        let small = |size: &f64| *size <= 1e-5;
        let terms = |parity: usize| (0..6).flat_map(move |j| (0..4).map(move |i| (j, 2 * i + parity)));
        let odd: f64 = terms(1).map(|(j, k)| fall(0, j, k)).filter(small).sum();
        let even: f64 = terms(0).map(|(j, k)| fall(4, j, k)).filter(small).sum();
        assert!((left / (odd + even) - 1.0).abs() < 1e-12, "{left:e} {odd:e} {even:e}");
        table.scale_every_other(3.0);
        let [first, ..] = table.coefficients[0];
        assert_eq!(first.changing, [[0.0; 4], [0.1, 3.0 * fall(1, 0, 1), fall(2, 0, 1), 3.0 * fall(3, 0, 1)]]);
        assert_eq!(first.others, [0.0, 0.0, fall(4, 0, 0), 3.0 * fall(5, 0, 0)]);
        // Rows beyond the last are zero.
        let [_, last, ..] = table.coefficients[3];
        assert_eq!((last.others[2], table.coefficients[3][2]), (fall(4, 5, 0), Coefficients::default()));
    }
}
