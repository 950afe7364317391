//! Directions in the space of unknowns that data do not determine, named.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::scaled_jacobian::ScaledJacobian;
use super::{Model, Unknown};
use crate::parameters::Parameter;

/// A direction along which data do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction<U = Parameter> {
    /// What cannot be told, where it has a name.
    pub words: Option<&'static str>,
    /// How much each unknown changes along it, the largest change one in the unknowns' own ranges.
    pub change: Vec<(U, f64)>,
    /// By how many standard deviations of the data they change with it, as a part of what each of these changes would do alone
    /// (root of the sum of squares).
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
        write!(f, " (the data change by {:.1e} of what each of these does alone)", self.ratio)
    }
}

fn rounded(x: f64) -> String {
    if x.abs() < 1e-3 { format!("{x:.2e}") } else { format!("{x:.4}") }
}

/// A unit vector this near to the space of null directions is one: a named symmetry is exact, so that only rounding parts it
/// from the space, by the rounding of the smallest singular values over that of the next.
const NEAR: f64 = 1e-5;

/// Sine of the least angle between a symmetry and the sums of those before it.
const INDEPENDENT: f64 = 1e-4;

/// The directions in the space of some unknowns.
pub(super) struct Directions<'a, U> {
    scaled: &'a ScaledJacobian,
    unknowns: &'a [U],
    ranges: DVector<f64>,
}

impl<'a, U: Unknown> Directions<'a, U> {
    pub(super) fn new(scaled: &'a ScaledJacobian, unknowns: &'a [U], model: &impl Model<Unknown = U>) -> Self {
        let ranges = unknowns.iter().map(|unknown| model.range(*unknown));
        Self { scaled, unknowns, ranges: DVector::from_iterator(unknowns.len(), ranges) }
    }

    /// The degenerate directions: one for each symmetry that is among them, and what is left.
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
            // Of the part that those before do not have. One that is a sum of them says nothing new.
            let new = &left * (left.transpose() * &vector);
            if left.ncols() > 0 && new.norm() > INDEPENDENT {
                found.push(self.direction(&vector, Some(symmetry.words)));
                left = without(&left, &new.normalize());
            }
        }
        found.extend(left.column_iter().map(|vector| self.direction(&vector.into_owned(), None)));
        found
    }

    /// The directions along which the data change by less than a standard deviation over the whole range of the unknowns: eigenvectors of their covariance in units of the ranges, of
    /// variances above one. That way round the ranges may differ by any factor: what rounding loses is in the small variances.
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

    /// A change of unknowns in columns of unit length, normalised; none if it changes something that is not unknown by more than
    /// [`NEAR`] of the largest change (as components of an `s^IJ` that is hardly there), or nothing.
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

    /// The direction of a vector in columns of unit length. Unknowns of which rounding is all that moves are left out.
    fn direction(&self, vector: &DVector<f64>, words: Option<&'static str>) -> Direction<U> {
        let Self { scaled, unknowns, ranges } = self;
        let unit = vector.normalize();
        let least = if words.is_some() { 1e-9 } else { 1e-3 };
        let moved = (0..unknowns.len()).filter(|&j| unit[j].abs() > least);
        let changes: Vec<(usize, f64)> = moved.map(|j| (j, unit[j] / scaled.lengths[j])).collect();
        // In units of the ranges, the largest one and positive.
        let in_range = changes.iter().map(|(j, change)| change / ranges[*j]);
        let largest = in_range.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        Direction {
            words,
            change: changes.iter().map(|(j, change)| (unknowns[*j], change / largest)).collect(),
            ratio: (scaled.vectors.transpose() * &unit).component_mul(&scaled.values).norm(),
        }
    }
}

/// An orthonormal basis of a space without one of its unit vectors.
fn without(space: &DMatrix<f64>, unit: &DVector<f64>) -> DMatrix<f64> {
    let left = space - unit * (unit.transpose() * space);
    let svd = left.svd(true, false);
    let u = svd.u.expect("asked for");
    let mut order: Vec<usize> = (0..svd.singular_values.len()).collect();
    order.sort_by(|a, b| svd.singular_values[*b].total_cmp(&svd.singular_values[*a]));
    order.truncate(space.ncols() - 1);
    u.select_columns(&order)
}
