//! Named directions in parameter space that the data do not determine.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::scaled_jacobian::ScaledJacobian;
use super::{Model, Unknown};
use crate::parameters::Parameter;

/// A direction along which data do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction<U = Parameter> {
    /// Description of the undetermined quantity, if it has a name.
    pub words: Option<&'static str>,
    /// Change of each unknown along the direction, scaled so that the largest is one in units of the unknowns' ranges.
    pub change: Vec<(U, f64)>,
    /// Change of the data along this direction (in standard deviations) relative to the root sum of squares of the changes
    /// that each unknown would cause alone.
    pub ratio: f64,
}

impl<U: Unknown> fmt::Display for Direction<U> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(words) = self.words {
            write!(f, "{words}; ")?;
        }
        let symbols: Vec<_> = self.change.iter().map(|(unknown, _)| format!("d({})", unknown.symbol())).collect();
        let sizes: Vec<_> = self.change.iter().map(|(_, size)| rounded(*size)).collect();
        match symbols.as_slice() {
            [symbol] => write!(f, "{symbol} alone")?,
            _ => write!(f, "{} = {}", symbols.join(" : "), sizes.join(" : "))?,
        }
        match (symbols.len(), self.ratio) {
            (1, 0.0) => write!(f, " (over its whole range no datum changes by more than rounding)"),
            (1, _) => write!(f, " (the data change by less than their errors over its whole range)"),
            (_, ratio) => write!(f, " (the data change by {ratio:.1e} of what these do alone, added in quadrature)"),
        }
    }
}

fn rounded(x: f64) -> String {
    if x.abs() < 1e-3 { format!("{x:.2e}") } else { format!("{x:.4}") }
}

/// A unit vector this close to the null space counts as part of it. A named symmetry is exact, so only rounding separates it
/// from the space: the rounding of the smallest singular values divided by the next singular value.
const NEAR: f64 = 1e-5;

/// Sine of the smallest angle allowed between a symmetry and the span of those before it.
const INDEPENDENT: f64 = 1e-4;

/// The directions in the space of a set of unknowns.
pub(super) struct Directions<'a, U> {
    scaled: &'a ScaledJacobian,
    unknowns: &'a [U],
    ranges: DVector<f64>,
}

impl<'a, U: Unknown> Directions<'a, U> {
    pub(super) fn new(scaled: &'a ScaledJacobian, unknowns: &'a [U], ranges: DVector<f64>) -> Self {
        Self { scaled, unknowns, ranges }
    }

    /// The degenerate directions: one for each symmetry that is among them, and the remaining ones.
    pub(super) fn degenerate(&self, model: &impl Model<Unknown = U>) -> Vec<Direction<U>> {
        let Self { scaled, unknowns, .. } = self;
        let nullity = scaled.nullity();
        let named = model.symmetries();
        let alone = |idle: &usize| {
            let unknown = unknowns[*idle];
            let words = named.iter().find(|symmetry| matches!(symmetry.change[..], [(one, _)] if one == unknown));
            Direction { words: words.map(|symmetry| symmetry.words), change: vec![(unknown, 1.0)], ratio: 0.0 }
        };
        let mut found: Vec<Direction<U>> = scaled.idle.iter().map(alone).collect();
        let null: DMatrix<f64> = scaled.vectors.columns(scaled.values.len() - nullity, nullity).into_owned();
        let mut left = null.clone();
        for symmetry in &named {
            let Some(vector) = self.in_scaled(&symmetry.change) else { continue };
            if (&vector - &null * (null.transpose() * &vector)).norm() > NEAR {
                continue;
            }
            // Only the part that the previous symmetries do not span counts: a linear combination of them says nothing new.
            let new = &left * (left.transpose() * &vector);
            if left.ncols() > 0 && new.norm() > INDEPENDENT {
                found.push(self.direction(&vector, Some(symmetry.words)));
                left = without(&left, &new);
            }
        }
        found.extend(left.column_iter().map(|vector| self.direction(&vector.into_owned(), None)));
        found
    }

    /// The directions along which the data change by less than a standard deviation over the whole range of the unknowns: eigenvectors of the
    /// covariance, in units of the ranges, with variances above one. With the covariance the ranges may differ by any factor, because rounding
    /// affects only the small variances.
    pub(super) fn weak(&self) -> Vec<Direction<U>> {
        let Self { scaled: ScaledJacobian { values, vectors, lengths, .. }, ranges, .. } = self;
        let rank = values.len() - self.scaled.nullity();
        if rank == 0 {
            return Vec::new();
        }
        let in_ranges = DMatrix::from_fn(rank, ranges.len(), |k, j| {
            if vectors[(j, k)] == 0.0 { 0.0 } else { vectors[(j, k)] / (values[k] * lengths[j] * ranges[j]) }
        });
        let svd = in_ranges.svd(false, true);
        let right = svd.v_t.expect("asked for");
        let weak = svd.singular_values.iter().zip(right.row_iter()).filter(|(value, _)| **value > 1.0);
        weak.map(|(_, row)| self.direction(&row.transpose().component_mul(ranges).component_mul(lengths), None))
            .collect()
    }

    /// A change of unknowns in terms of columns of unit length, normalised; `None` if it changes a known parameter by more than
    /// [`NEAR`] of the largest change (such as components of an `s^IJ` that is almost zero), or if it changes nothing.
    fn in_scaled(&self, change: &[(U, f64)]) -> Option<DVector<f64>> {
        let size = change.iter().fold(0.0, |most: f64, (_, part)| most.max(part.abs()));
        let mut vector = DVector::zeros(self.unknowns.len());
        for (unknown, part) in change.iter().filter(|(_, part)| part.abs() > 1e-14 * size) {
            match self.unknowns.iter().position(|other| other == unknown) {
                Some(place) => vector[place] = part * self.scaled.lengths[place],
                None if part.abs() <= NEAR * size => {}
                None => return None,
            }
        }
        let norm = vector.norm();
        (norm > 0.0).then(|| vector / norm)
    }

    /// The direction of a vector in terms of columns of unit length. Unknowns that only rounding moves are left out.
    fn direction(&self, vector: &DVector<f64>, words: Option<&'static str>) -> Direction<U> {
        let Self { scaled, unknowns, ranges } = self;
        let unit = vector.normalize();
        let least = if words.is_some() { 1e-9 } else { 1e-3 };
        let moved = (0..unknowns.len()).filter(|&j| unit[j].abs() > least);
        let changes: Vec<(usize, f64)> = moved.map(|j| (j, unit[j] / scaled.lengths[j])).collect();
        // In units of the ranges, with the largest change one and positive.
        let in_range = changes.iter().map(|(j, change)| change / ranges[*j]);
        let largest = in_range.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        Direction {
            words,
            change: changes.iter().map(|(j, change)| (unknowns[*j], change / largest)).collect(),
            ratio: (scaled.vectors.transpose() * &unit).component_mul(&scaled.values).norm(),
        }
    }
}

/// An orthonormal basis of a space with one of its directions removed.
fn without(space: &DMatrix<f64>, direction: &DVector<f64>) -> DMatrix<f64> {
    let unit = direction.normalize();
    let left = space - &unit * (unit.transpose() * space);
    // The last vector, with the smallest singular value, is the removed one.
    let u = left.svd(true, false).u.expect("asked for");
    u.columns(0, space.ncols() - 1).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inference::functions::{A, B, Fraction, Name, Numbers, exact};
    use crate::inference::{Fisher, Symmetry};

    /// The Fisher matrix of data with this Jacobian with respect to the three numbers.
    fn told(rows: &[[f64; 3]], model: &Numbers) -> Fisher<Numbers> {
        let matrix = DMatrix::from_fn(rows.len(), 3, |row, column| rows[row][column]);
        Fisher::of_jacobian(&exact(matrix), &[A, B, Fraction], model)
    }

    fn with_symmetries(symmetries: &[(&'static str, &[(Name, f64)])]) -> Numbers {
        let of = |(words, change): &(&'static str, &[(Name, f64)])| Symmetry { words, change: change.to_vec() };
        Numbers { symmetries: symmetries.iter().map(of).collect(), ..Numbers::new([0.0; 3], [1.0; 3]) }
    }

    fn assert_change(found: &Direction<Name>, expected: &[(Name, f64)], exact_to: f64) {
        let names: Vec<Name> = found.change.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, expected.iter().map(|(name, _)| *name).collect::<Vec<_>>(), "{found:?}");
        for ((_, size), (_, wanted)) in found.change.iter().zip(expected) {
            assert!((size - wanted).abs() <= exact_to * wanted.abs(), "{found:?}");
        }
    }

    #[test]
    fn directions_are_written_with_four_digits() {
        let direction = |words, change: &[(Name, f64)]| Direction { words, change: change.to_vec(), ratio: 1.25e-13 };
        let weak = "d(a) alone (the data change by less than their errors over its whole range)";
        assert_eq!(direction(None, &[(A, 1.0)]).to_string(), weak);
        let idle = Direction { ratio: 0.0, ..direction(None, &[(A, 1.0)]) };
        assert_eq!(idle.to_string(), "d(a) alone (over its whole range no datum changes by more than rounding)");
        let alone = " (the data change by 1.2e-13 of what these do alone, added in quadrature)";
        let found = direction(Some("a against b"), &[(A, 1.0), (B, -0.5), (Fraction, 1e-3)]).to_string();
        assert_eq!(found, format!("a against b; d(a) : d(b) : d(f) = 1.0000 : -0.5000 : 0.0010{alone}"));
        let found = direction(None, &[(A, 9.99e-4), (B, -9.99e-4)]).to_string();
        assert_eq!(found, format!("d(a) : d(b) = 9.99e-4 : -9.99e-4{alone}"));
    }

    #[test]
    fn a_number_that_no_datum_depends_on_stands_alone() {
        let named = with_symmetries(&[("b is seen by nobody", &[(B, 1.0)])]);
        for (model, words) in [(Numbers::new([0.0; 3], [1.0; 3]), None), (named, Some("b is seen by nobody"))] {
            let found = told(&[[1.0, 0.0, 1.0], [2.0, 0.0, -1.0], [0.0, 0.0, 3.0]], &model);
            let expected = Direction { words, change: vec![(B, 1.0)], ratio: 0.0 };
            assert_eq!(found.degenerate, [expected]);
            assert!(found.weak.is_empty());
        }
    }

    /// The data are functions of `a + 2 b` and `f` only.
    #[test]
    fn what_data_do_not_determine_is_found_and_named() {
        let rows = [[1.0, 2.0, 0.0], [3.0, 6.0, 1.0], [0.0, 0.0, 2.0]];
        let against = [(A, 1.0), (B, -0.5)];
        let unnamed = told(&rows, &Numbers::new([0.0; 3], [1.0; 3])).degenerate;
        assert_eq!((unnamed.len(), unnamed[0].words), (1, None));
        assert_change(&unnamed[0], &against, 1e-12);
        assert!(unnamed[0].ratio < 1e-14, "{unnamed:?}");
        // A symmetry that the data do not have is not reported.
        let model = with_symmetries(&[("others", &[(A, 1.0), (B, 0.5)]), ("a against b", &[(A, -4.0), (B, 2.0)])]);
        let named = told(&rows, &model).degenerate;
        assert_eq!((named.len(), named[0].words), (1, Some("a against b")));
        assert_change(&named[0], &against, 1e-12);
    }

    /// A symmetry may not change known parameters by more than a hundred-thousandth of it.
    #[test]
    fn symmetries_change_unknowns_alone() {
        let rows = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 3.0, 6.0]);
        for (part, is_named) in [(1e-4, false), (1.1e-5, false), (0.9e-5, true), (-0.9e-5, true), (1e-15, true)] {
            let model = with_symmetries(&[("a against b", &[(A, 1.0), (B, -0.5), (Fraction, part)])]);
            let found = Fisher::of_jacobian(&exact(rows.clone()), &[A, B], &model).degenerate;
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].words.is_some(), is_named, "{part}");
            // The same change a thousandth as large, and a billion times as large with the parts of the unknowns off by a
            // millionth.
            for (size, off) in [(1e-3, 0.0), (1e9, 1e-6)] {
                let change = [(A, size), (B, -0.5 * size * (1.0 + off)), (Fraction, part * size)];
                let found =
                    Fisher::of_jacobian(&exact(rows.clone()), &[A, B], &with_symmetries(&[("a against b", &change)]))
                        .degenerate;
                assert_eq!(found[0].words.is_some(), is_named, "{part} {size}");
            }
        }
        // A part of a million-millionth counts if the data depend on it a million million times as strongly.
        let rows = DMatrix::from_row_slice(2, 2, &[1.0, 1e12, 3.0, 3e12]);
        let model = with_symmetries(&[("a against b", &[(A, 1.0), (B, -1e-12)])]);
        let found = Fisher::of_jacobian(&exact(rows), &[A, B], &model).degenerate;
        assert_eq!(found.iter().map(|one| one.words).collect::<Vec<_>>(), [Some("a against b")]);
    }

    /// All data are functions of `a + b + f`. Each symmetry names one of the two directions, even if the second equals the first to within a
    /// thousandth; the remainder is orthogonal to the named ones, to rounding.
    #[test]
    fn every_symmetry_that_says_something_new_is_named() {
        let rows = [[1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [-1.0, -1.0, -1.0]];
        let first: &[(Name, f64)] = &[(A, 1.0), (B, -1.0)];
        let nearly: &[(Name, f64)] = &[(A, 1.0), (B, -0.999), (Fraction, -0.001)];
        let found = told(&rows, &with_symmetries(&[("first", first), ("again", first), ("nearly", nearly)])).degenerate;
        assert_eq!(found.iter().map(|one| one.words).collect::<Vec<_>>(), [Some("first"), Some("nearly")]);
        assert_change(&found[1], nearly, 1e-11);
        let found = told(&rows, &with_symmetries(&[("first", first)])).degenerate;
        assert_eq!(found.iter().map(|one| one.words).collect::<Vec<_>>(), [Some("first"), None]);
        let [Some((A, a)), Some((B, b)), Some((Fraction, f))] = [0, 1, 2].map(|k| found[1].change.get(k).copied())
        else {
            panic!("{found:?}")
        };
        assert!((a - b).abs() < 1e-14 && (a + b + f).abs() < 1e-14 && (f - 1.0).abs() < 1e-14, "{found:?}");
    }

    /// This holds also if the removed direction is given by a short vector, such as the part of a symmetry that others
    /// do not have.
    #[test]
    fn what_is_left_over_is_exact() {
        let null = DMatrix::from_column_slice(3, 3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        let unit = DVector::from_column_slice(&[0.6, 0.8, 0.0]);
        let left = without(&null, &(1e-3 * &unit));
        assert_eq!((left.nrows(), left.ncols()), (3, 2));
        // A product of vectors of length one, each with some roundings.
        assert!((left.transpose() * &unit).norm() < 1e-14);
        assert!((left.transpose() * &left - DMatrix::identity(2, 2)).norm() < 1e-14);
    }

    /// Small components of a symmetry come from its formula; those of a direction without a name are rounding.
    #[test]
    fn small_parts_of_named_directions_are_kept() {
        let part = 1e-7;
        // The columns of a and b and a ten-millionth of the column of f add up to zero.
        let rows = [[1.0, -1.0, 0.0], [0.0, -part, 1.0], [0.0, 0.0, 0.0]];
        let model = with_symmetries(&[("all", &[(A, 1.0), (B, 1.0), (Fraction, part)])]);
        let found = told(&rows, &model).degenerate;
        assert_change(&found[0], &[(A, 1.0), (B, 1.0), (Fraction, part)], 1e-12);
        let found = told(&rows, &Numbers::new([0.0; 3], [1.0; 3])).degenerate;
        assert_change(&found[0], &[(A, 1.0), (B, 1.0)], 1e-12);
    }

    /// For independent data of standard deviations 1/2, 1/10 and 1/30, the range of a number decides whether it is weakly determined.
    #[test]
    fn weak_directions_are_those_of_errors_beyond_the_range() {
        let rows = [[2.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 30.0]];
        let weak = |ranges: [f64; 3]| told(&rows, &Numbers::new([0.0; 3], ranges)).weak;
        assert!(weak([0.51, 0.11, 0.034]).is_empty());
        for (ranges, name) in [([0.49, 0.11, 0.034], A), ([0.51, 0.09, 0.034], B), ([0.51, 0.11, 0.033], Fraction)] {
            let found = weak(ranges);
            assert_eq!(found.len(), 1, "{found:?}");
            // Over its full range.
            assert_change(&found[0], &[(name, ranges[name as usize])], 1e-12);
            assert_eq!(found[0].words, None);
        }
        // If only the sum of two numbers is well known, the difference is weak, each in its range.
        let rows = [[1e3, 1e3, 0.0], [1e-3, -1e-3, 0.0], [0.0, 0.0, 1.0]];
        let found = told(&rows, &Numbers::new([0.0; 3], [1.0, 1.0, 10.0])).weak;
        assert_eq!(found.len(), 1, "{found:?}");
        assert_change(&found[0], &[(A, 1.0), (B, -1.0)], 1e-6);
        // The difference changes the data by 2e-3, whereas either number alone changes them by 1e3, so both by `sqrt(2)`
        // times that.
        assert!((found[0].ratio / (2e-6 / 2.0_f64.sqrt()) - 1.0).abs() < 1e-4, "{found:?}");
        // A number that no datum depends on is degenerate, not weak.
        let found = told(&[[0.0; 3], [0.0; 3], [0.0; 3]], &Numbers::new([0.0; 3], [1.0; 3]));
        assert!(found.weak.is_empty() && found.degenerate.len() == 3);
    }
}
