//! Directions in the space of unknowns that data do not determine, named.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::fisher::ScaledJacobian;
use super::symmetry::symmetries;
use super::{Model, Unknown};

/// A direction along which data do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// What cannot be told, where it has a name.
    pub words: Option<&'static str>,
    /// How much each unknown changes along it, the largest change one in the unknowns' own ranges.
    pub change: Vec<(Unknown, f64)>,
    /// By how many standard deviations of the data they change with it, as a part of what each of these changes would do alone
    /// (root of the sum of squares).
    pub ratio: f64,
}

impl fmt::Display for Direction {
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

/// The degenerate directions: one for each symmetry that is among them, and what is left.
pub(super) fn directions(scaled: &ScaledJacobian, unknowns: &[Unknown], model: &Model<f64>) -> Vec<Direction> {
    let nullity = scaled.nullity();
    let rank = scaled.values.len() - nullity;
    let mut found = Vec::new();
    let named = symmetries(model);
    for &idle in &scaled.idle {
        let words = named.iter().find(|symmetry| matches!(symmetry.change[..], [(one, _)] if one == unknowns[idle]));
        found.push(Direction {
            words: words.map(|symmetry| symmetry.words),
            change: vec![(unknowns[idle], 1.0)],
            ratio: 0.0,
        });
    }
    let null: DMatrix<f64> = scaled.vectors.columns(rank, nullity).into_owned();
    let mut left = null.clone();
    for symmetry in &named {
        let Some(vector) = in_scaled(&symmetry.change, unknowns, &scaled.lengths) else { continue };
        if (&vector - &null * (null.transpose() * &vector)).norm() > NEAR {
            continue;
        }
        // Of the part that those before do not have. One that is a sum of them says nothing new.
        let new = &left * (left.transpose() * &vector);
        if left.ncols() > 0 && new.norm() > INDEPENDENT {
            found.push(direction(&vector, scaled, unknowns, model, Some(symmetry.words)));
            left = without(&left, &new.normalize());
        }
    }
    found.extend(left.column_iter().map(|vector| direction(&vector.into_owned(), scaled, unknowns, model, None)));
    found
}

/// The directions along which the data change by less than a standard deviation over the whole range of the unknowns.
pub(super) fn weak_directions(
    scaled: &ScaledJacobian,
    unknowns: &[Unknown],
    model: &Model<f64>,
    ranges: &[f64],
) -> Vec<Direction> {
    let rank = scaled.values.len() - scaled.nullity();
    if rank == 0 {
        return Vec::new();
    }
    // J = U S V^T D with the lengths D: J times the ranges has the singular values and vectors of S V^T D R.
    let mut rows = DMatrix::zeros(rank, unknowns.len());
    for k in 0..rank {
        for j in 0..unknowns.len() {
            rows[(k, j)] = scaled.values[k] * scaled.vectors[(j, k)] * scaled.lengths[j] * ranges[j];
        }
    }
    let svd = rows.svd(false, true);
    let vectors = svd.v_t.expect("asked for");
    (0..svd.singular_values.len())
        .filter(|k| svd.singular_values[*k] < 1.0)
        .map(|k| {
            let change = vectors.row(k).transpose().component_mul(&DVector::from_column_slice(ranges));
            direction(&change.component_mul(&scaled.lengths), scaled, unknowns, model, None)
        })
        .collect()
}

/// A change of unknowns in columns of unit length, normalised; none if it changes something that is not unknown by more than
/// [`NEAR`] of the largest change (as components of an `s^IJ` that is hardly there), or nothing.
fn in_scaled(change: &[(Unknown, f64)], unknowns: &[Unknown], lengths: &DVector<f64>) -> Option<DVector<f64>> {
    let size = change.iter().fold(0.0, |most: f64, (_, part)| most.max(part.abs()));
    let mut vector = DVector::zeros(unknowns.len());
    for (unknown, part) in change.iter().filter(|(_, part)| part.abs() > 1e-14 * size) {
        match unknowns.iter().position(|other| other == unknown) {
            Some(place) => vector[place] = part * lengths[place],
            None if part.abs() <= NEAR * size => {}
            None => return None,
        }
    }
    let norm = vector.norm();
    (norm > 0.0).then(|| vector / norm)
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

/// The direction of a vector in columns of unit length. Unknowns of which rounding is all that moves are left out.
fn direction(
    vector: &DVector<f64>,
    scaled: &ScaledJacobian,
    unknowns: &[Unknown],
    model: &Model<f64>,
    words: Option<&'static str>,
) -> Direction {
    let unit = vector.normalize();
    let coordinates = scaled.vectors.transpose() * &unit;
    let moved = coordinates.component_mul(&scaled.values).norm();
    let places: Vec<usize> =
        (0..unknowns.len()).filter(|&j| unit[j].abs() > 1e-3 || words.is_some() && unit[j].abs() > 1e-9).collect();
    let changes: Vec<f64> = places.iter().map(|&j| unit[j] / scaled.lengths[j]).collect();
    // In units of the ranges, the largest one and positive.
    let in_range = |place: usize| changes[place] / unknowns[places[place]].range(model);
    let largest = (0..places.len()).max_by(|a, b| in_range(*a).abs().total_cmp(&in_range(*b).abs()));
    let unit_change = largest.map_or(1.0, in_range);
    let change = places.iter().zip(&changes).map(|(&j, change)| (unknowns[j], change / unit_change));
    Direction { words, change: change.collect(), ratio: moved }
}
