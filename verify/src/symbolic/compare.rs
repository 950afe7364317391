//! The comparison of every kernel with every exact value.

use std::collections::BTreeSet;

use super::document::Document;
use super::{closed_kernels, rational_kernels};
use crate::prelude::*;

/// Every rational kernel over the prime field: the number of values that are not images of the exact ones.
pub(crate) fn compare_field(document: &Document) -> Result<Measured, String> {
    let kernels = rational_kernels();
    let values = |i: usize, point: &_| Ok((kernels[i].field)(&document.layout.coded(point)));
    let pairs = pairs(document, &document.exact, kernels.iter().map(|kernel| kernel.name), values)?;
    let mut differing = Vec::new();
    for (place, value, expected) in &pairs {
        if *value != image(&expected.text)? {
            differing.push(place);
        }
    }
    Ok(Measured::new(differing.len() as f64, format!("{} values; first {:?}", pairs.len(), differing.first())))
}

/// Compares every rational kernel in doubles: the largest error in units of 2.2e-16 times the sum of the magnitudes of the terms.
pub(crate) fn compare_doubles(document: &Document) -> Result<Measured, String> {
    let kernels = rational_kernels();
    let values = |i: usize, point: &_| {
        let (values, scales) = ((kernels[i].doubles)(&document.layout.coded(point)), &document.layout.coded(point));
        Ok(values.into_iter().zip((kernels[i].conditioned)(scales)).collect())
    };
    worst_of(
        pairs(document, &document.exact, kernels.iter().map(|kernel| kernel.name), values)?,
        |(_, (value, scale), expected)| Ok(error_over_scale(*value, expected.nearest, scale.magnitude)),
    )
}

/// Compares every other kernel in doubles: the largest error in units of 2.2e-16 times the scale in the file.
pub(crate) fn compare_closed(document: &Document) -> Result<Measured, String> {
    let kernels = closed_kernels();
    let values = |i: usize, point: &_| (kernels[i].values)(&document.layout.coded(point));
    worst_of(
        pairs(document, &document.rounded, kernels.iter().map(|kernel| kernel.name), values)?,
        |(_, value, expected)| Ok(error_over_scale(*value, expected.value, expected.scale)),
    )
}

/// Name, point and component of a value, the value, and its entry in the file.
type Pair<'d, V, E> = ((&'static str, usize, usize), V, &'d E);

/// The values of all kernels of a kind at all points.
fn pairs<'d, V, E>(
    document: &'d Document,
    file: &'d BTreeMap<String, Vec<Vec<E>>>,
    names: impl Iterator<Item = &'static str>,
    values: impl Fn(usize, &BTreeMap<String, (i32, i32)>) -> Result<Vec<V>, Error>,
) -> Result<Vec<Pair<'d, V, E>>, String> {
    let (names, mut pairs) = (names.collect::<Vec<_>>(), Vec::new());
    let (in_file, ours): (BTreeSet<&str>, BTreeSet<&str>) =
        (file.keys().map(String::as_str).collect(), names.iter().copied().collect());
    if in_file != ours || names.is_empty() || document.points.is_empty() {
        return Err(format!("quantities on one side only: {:?}", in_file.symmetric_difference(&ours)));
    }
    for (i, name) in names.into_iter().enumerate() {
        if file[name].len() != document.points.len() {
            return Err(format!("{name} has {} points of {}", file[name].len(), document.points.len()));
        }
        for (index, (point, expected)) in document.points.iter().zip(&file[name]).enumerate() {
            let values = values(i, point).map_err(|error| format!("{name} refuses point {index}: {error}"))?;
            if values.len() != expected.len() {
                return Err(format!("{name} has {} components here, {} in the file", values.len(), expected.len()));
            }
            let places = (0..values.len()).map(|component| (name, index, component));
            pairs.extend(places.zip(values).zip(expected).map(|((place, value), expected)| (place, value, expected)));
        }
    }
    if pairs.is_empty() { Err("the file has no value".into()) } else { Ok(pairs) }
}

fn error_over_scale(value: f64, expected: f64, scale: f64) -> f64 {
    match value == expected {
        true => 0.0,
        // An infinite scale would excuse any error.
        false if !scale.is_finite() => f64::NAN,
        false => (value - expected).abs() / (f64::EPSILON * scale),
    }
}

/// The image of `"n/d"` in the prime field; the integers may have any number of digits.
fn image(text: &str) -> Result<Fp, String> {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let integer = |digits: &str| {
        let (sign, digits) = digits.strip_prefix('-').map_or((1.0, digits), |rest| (-1.0, rest));
        digits
            .chars()
            .try_fold(Fp::zero(), |sum, digit| Some(sum * 10.0 + Fp::new(digit.to_digit(10)?.into())))
            .filter(|_| !digits.is_empty())
            .map(|value| value * sign)
            .ok_or_else(|| format!("{text} is no fraction"))
    };
    let denominator = integer(denominator)?;
    if denominator.is_zero() {
        return Err(format!("the denominator of {text} vanishes in the prime field"));
    }
    Ok(integer(numerator)? * (Fp::from_f64(1.0) / denominator))
}
