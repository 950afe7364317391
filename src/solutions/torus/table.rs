//! Tables of Fourier coefficients, and their sums.

use super::fourier::{Pair, Reflection};
use crate::numerics::four_lanes::FourLanes;

/// Cosines and sines of four consecutive multiples of an angle, and of the angle times four.
#[derive(Clone, Copy)]
pub(super) struct FourMultiples<F: FourLanes> {
    cos: F::Lanes,
    sin: F::Lanes,
    cos_of_four: F::Lanes,
    sin_of_four: F::Lanes,
    minus_sin_of_four: F::Lanes,
}

impl<F: FourLanes> FourMultiples<F> {
    /// Starting at zero.
    #[inline(always)]
    pub(super) fn first(four: F, (sin, cos): (f64, f64)) -> Self {
        let across = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, b * c + a * d];
        let first = [cos, sin];
        let second = across(first, first);
        let (third, [c, s]) = (across(second, first), across(second, second));
        Self {
            cos: four.load(&[1.0, first[0], second[0], third[0]]),
            sin: four.load(&[0.0, first[1], second[1], third[1]]),
            cos_of_four: four.all(c),
            sin_of_four: four.all(s),
            minus_sin_of_four: four.all(-s),
        }
    }

    /// The next four multiples.
    #[inline(always)]
    fn next(self, four: F) -> Self {
        let zero = four.all(0.0);
        let turned =
            |by_cos, by_sin, sin| four.multiply_add(by_cos, self.cos_of_four, four.multiply_add(by_sin, sin, zero));
        let cos = turned(self.cos, self.sin, self.minus_sin_of_four);
        Self { cos, sin: turned(self.sin, self.cos, self.sin_of_four), ..self }
    }
}

/// Cosines and sines of multiples of an angle, starting at zero, in blocks of four.
pub(super) struct Multiples<'a> {
    cos: &'a [[f64; 4]],
    sin: &'a [[f64; 4]],
}

impl<'a> Multiples<'a> {
    /// Computes them: the first half of a slice for the cosines and the second half for the sines.
    #[inline(always)]
    pub(super) fn fill<F: FourLanes>(four: F, blocks: &'a mut [[f64; 4]], mut these: FourMultiples<F>) -> Self {
        let (of_cos, of_sin) = blocks.split_at_mut(blocks.len() / 2);
        for (cos, sin) in of_cos.iter_mut().zip(of_sin.iter_mut()) {
            (*cos, *sin) = (four.store(these.cos), four.store(these.sin));
            these = these.next(four);
        }
        Self { cos: of_cos, sin: of_sin }
    }
}

/// Fourier coefficients of six functions on the torus. Half a turn of the second angle changes the sign of the first four, which have
/// `k = 1, 3, ...`, and not of the others, with `k = 0, 2, ...`. The first two and the fifth are even under a reflection in the plane, the next two
/// odd; the last one is either, as requested.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// For every four multiples `j` of the first angle, the number of `i` that are stored: `k = 2 i` and `2 i + 1`.
    counts: Vec<usize>,
    /// For each of these `i` the coefficients of the six functions.
    coefficients: Vec<[Coefficients; 6]>,
}

/// Coefficients of a function for four `j` and one `i`: those with `cos k theta_2` and with `sin k theta_2`.
type Coefficients = [[f64; 4]; 2];

/// The coefficients of a function for `j` and `i`; zero beyond its last.
fn pair(table: &[Vec<Pair>], j: usize, i: usize) -> Pair {
    table.get(j).and_then(|row| row.get(i)).copied().unwrap_or_default()
}

/// Number of coefficients of functions with the same pairs of frequencies that are above the smallest, for a multiple `j` of the first angle, and the
/// sum of those after them.
fn above(functions: &[Vec<Vec<Pair>>], j: usize, smallest: f64) -> (usize, f64) {
    let largest =
        |i: usize| functions.iter().flat_map(|table| pair(table, j, i)).fold(0.0, |most: f64, x| most.max(x.abs()));
    let length = functions[0][j].len();
    let count = (0..length).rev().find(|&i| largest(i) > smallest).map_or(0, |i| i + 1);
    (count, (count..length).map(largest).sum())
}

impl Table {
    /// The table of six functions from their coefficients `[j][i]`, `k = 2 i` or `2 i + 1`, without the smallest ones, whose sum is at most a
    /// tolerance (if rounding permits); and that sum.
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

    /// The table without the coefficients after those above the smallest, and the sum of the omitted ones. Four rows have the length of the longest
    /// of them, so that the shorter rows keep some of the small coefficients. For a row that ends with the grid the sum also represents the
    /// coefficients beyond the grid.
    fn without_smallest(functions: &[Vec<Vec<Pair>>; 6], smallest: f64) -> (Self, f64) {
        let mut left = 0.0;
        let mut table = Self::default();
        let of = |function: usize, first: usize, i: usize| {
            [0, 1].map(|part| core::array::from_fn(|row| pair(&functions[function], first + row, i)[part]))
        };
        let length = functions[0].len();
        for first in (0..length).step_by(4) {
            let rows =
                (first..length.min(first + 4)).flat_map(|j| [&functions[..4], &functions[4..]].map(|of| (of, j)));
            let (counts, omitted): (Vec<_>, Vec<_>) = rows.map(|(of, j)| above(of, j, smallest)).unzip();
            let count = counts.into_iter().max().unwrap_or(0);
            left += omitted.iter().sum::<f64>();
            table.counts.push(count);
            table.coefficients.extend((0..count).map(|i| core::array::from_fn(|function| of(function, first, i))));
        }
        while table.counts.last() == Some(&0) {
            table.counts.pop();
        }
        (table, left)
    }

    /// Number of blocks of four multiples of the second angle that are needed.
    pub(super) fn blocks(&self) -> usize {
        self.counts.iter().map(|count| count.div_ceil(2)).max().unwrap_or(0)
    }

    /// Number of pairs of frequencies.
    pub(super) fn len(&self) -> usize {
        8 * self.coefficients.len()
    }

    /// Multiplies the second, the fourth and the sixth function by a factor.
    pub(super) fn scale_every_other(&mut self, factor: f64) {
        for functions in &mut self.coefficients {
            for function in [1, 3, 5] {
                functions[function].as_flattened_mut().iter_mut().for_each(|x| *x *= factor);
            }
        }
    }

    /// The sums for multiples of both angles, the sixth taken as an even or as an odd function.
    #[inline(always)]
    pub(super) fn at<F: FourLanes>(
        &self,
        four: F,
        mut first: FourMultiples<F>,
        second: &Multiples<'_>,
        sixth: Reflection,
    ) -> [f64; 6] {
        let mut coefficients = self.coefficients.as_slice();
        let mut sums = [four.all(0.0); 6];
        let [cos_k, sin_k] = [second.cos, second.sin].map(|multiples| multiples.as_flattened().as_chunks::<2>().0);
        for &count in &self.counts {
            let (block, rest) = coefficients.split_at(count);
            coefficients = rest;
            // Twelve sums at once, so that none waits for the previous one.
            let mut rows = [[four.all(0.0); 2]; 6];
            for ((functions, [even_cos, odd_cos]), [even_sin, odd_sin]) in block.iter().zip(cos_k).zip(sin_k) {
                let odd = [four.all(*odd_cos), four.all(*odd_sin)];
                let even = [four.all(*even_cos), four.all(*even_sin)];
                for (f, (row, [a, b])) in rows.iter_mut().zip(functions).enumerate() {
                    let [cos, sin] = if f < 4 { odd } else { even };
                    row[0] = four.multiply_add(four.load(a), cos, row[0]);
                    row[1] = four.multiply_add(four.load(b), sin, row[1]);
                }
            }
            for (f, (sum, [with_cos, with_sin])) in sums.iter_mut().zip(rows).enumerate() {
                let is_odd = f == 2 || f == 3 || f == 5 && sixth == Reflection::Odd;
                let (a, b) = if is_odd { (first.sin, first.cos) } else { (first.cos, first.sin) };
                *sum = four.multiply_add(with_sin, b, four.multiply_add(with_cos, a, *sum));
            }
            first = first.next(four);
        }
        sums.map(|lanes| {
            let [a, b, c, d] = four.store(lanes);
            (a + c) + (b + d)
        })
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
        let found = Multiples::fill(plain(), &mut blocks, FourMultiples::first(plain(), 0.7_f64.sin_cos()));
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
        let of_zero = table.coefficients[2].map(|function| function.map(|rows| rows[0]));
        assert_eq!(of_zero, [[0.0; 2], [0.0; 2], [0.0; 2], [0.0; 2], [1.0; 2], [1.0; 2]]);
    }

    /// Six functions with different coefficients, summed term by term, with vectors and one by one.
    #[test]
    fn sums_are_those_of_all_terms() {
        let size = |f: usize, j: usize, k: usize, part: usize| 1.0 / (1.0 + (f + 2 * j + 3 * k + 5 * part) as f64);
        let functions: [Vec<Vec<Pair>>; 6] = core::array::from_fn(|f| {
            let parity = usize::from(f < 4);
            let row = |j: usize| (0..4).map(|i| [0, 1].map(|part| size(f, j, 2 * i + parity, part))).collect();
            (0..5).map(row).collect()
        });
        let (table, left) = Table::without_smallest(&functions, 0.0);
        assert_eq!((left, table.blocks(), table.len()), (0.0, 2, 64));
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
        let mut blocks = [[0.0; 4]; 4];
        let [first, second] = [a, b].map(|angle| angle.sin_cos());
        let second = Multiples::fill(plain(), &mut blocks, FourMultiples::first(plain(), second));
        for sixth in [Reflection::Even, Reflection::Odd] {
            let is_even = [true, true, false, false, true, sixth == Reflection::Even];
            let near = |found: [f64; 6]| {
                for (f, found) in found.into_iter().enumerate() {
                    assert!((found - of(f, is_even[f])).abs() < 1e-14, "{f} {sixth:?}: {found}");
                }
            };
            near(table.at(plain(), FourMultiples::first(plain(), first), &second, sixth));
            if let Some(fused) = detect_fused() {
                near(run_fused(fused, || table.at(fused, FourMultiples::first(fused, first), &second, sixth)));
            }
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
        assert_eq!((table.counts.as_slice(), table.blocks()), (&[3, 1][..], 2));
        // Among the first four functions the first is the largest, among the others the fifth.
        let small = |size: &f64| *size <= 1e-5;
        let terms = |parity: usize| (0..6).flat_map(move |j| (0..4).map(move |i| (j, 2 * i + parity)));
        let odd: f64 = terms(1).map(|(j, k)| fall(0, j, k)).filter(small).sum();
        let even: f64 = terms(0).map(|(j, k)| fall(4, j, k)).filter(small).sum();
        assert!((left / (odd + even) - 1.0).abs() < 1e-12, "{left:e} {odd:e} {even:e}");
        table.scale_every_other(3.0);
        // By function and component.
        let of_row = |cell: usize, row: usize| table.coefficients[cell].map(|function| function.map(|rows| rows[row]));
        let scaled = [1.0, 3.0, 1.0, 3.0, 1.0, 3.0];
        let expected = core::array::from_fn(|f| [0.0, scaled[f] * fall(f, 0, usize::from(f < 4))]);
        assert_eq!(of_row(0, 0), expected);
        // Rows beyond the last are zero.
        assert_eq!((of_row(3, 1)[4][1], of_row(3, 2)), (fall(4, 5, 0), [[0.0; 2]; 6]));
    }
}
