//! The comparison of every kernel with every exact value.

use std::collections::BTreeSet;

use super::document::Document;
use super::{closed_kernels, rational_kernels};
use crate::prelude::*;

/// What a comparison counted.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Values compared.
    pub count: usize,
    /// Values that differ, or the largest error in units of the last place, by the kind of comparison.
    pub figure: f64,
    /// Where the first or worst was.
    pub detail: String,
}

/// Every rational kernel over the prime field: how many values differ from the images of the exact ones.
///
/// # Errors
/// If kernels and file do not have the same names and numbers of components.
pub fn compare_field(document: &Document) -> Result<Comparison, String> {
    let kernels = rational_kernels();
    same_names("exact", document.exact.keys(), kernels.iter().map(|kernel| kernel.name))?;
    let (mut count, mut differ, mut first) = (0, 0, String::new());
    for kernel in kernels {
        for (index, (point, expected)) in document.points.iter().zip(&document.exact[kernel.name]).enumerate() {
            let values = (kernel.field)(&document.layout.coded(point));
            same_length(kernel.name, values.len(), expected.len())?;
            for (component, (value, expected)) in values.into_iter().zip(expected).enumerate() {
                count += 1;
                if value != image(&expected.text)? {
                    differ += 1;
                    if first.is_empty() {
                        first = format!("; first in {}, component {component}, point {index}", kernel.name);
                    }
                }
            }
        }
    }
    nonempty(count)?;
    Ok(Comparison { count, figure: f64::from(differ), detail: format!("{count} values{first}") })
}

/// Every kernel in doubles: the largest error in units of 2.2e-16 times the scale, which for a rational kernel is the sum of the magnitudes of
/// its terms, for others the scale of the file; separately for the two kinds.
///
/// # Errors
/// If kernels and file do not have the same names and numbers of components, or a kernel refuses a point.
pub fn compare_doubles(document: &Document) -> Result<[Comparison; 2], String> {
    let (mut worst, mut count) = (Worst::default(), 0);
    let kernels = rational_kernels();
    same_names("exact", document.exact.keys(), kernels.iter().map(|kernel| kernel.name))?;
    for kernel in kernels {
        for (index, (point, expected)) in document.points.iter().zip(&document.exact[kernel.name]).enumerate() {
            let values = (kernel.doubles)(&document.layout.coded(point));
            let scales = (kernel.conditioned)(&document.layout.coded(point));
            same_length(kernel.name, values.len(), expected.len())?;
            for (component, ((value, scale), expected)) in values.iter().zip(scales).zip(expected).enumerate() {
                count += 1;
                let figure = error_over_scale(*value, expected.nearest, scale.magnitude);
                worst.see(figure, || format!("{}, component {component}, point {index}: {value:e}", kernel.name));
            }
        }
    }
    let rational = finish(worst, count)?;
    let (mut worst, mut count) = (Worst::default(), 0);
    let kernels = closed_kernels();
    same_names("rounded", document.rounded.keys(), kernels.iter().map(|kernel| kernel.name))?;
    for kernel in kernels {
        for (index, (point, expected)) in document.points.iter().zip(&document.rounded[kernel.name]).enumerate() {
            let values = (kernel.values)(&document.layout.coded(point))
                .map_err(|error| format!("{} refuses point {index}: {error}", kernel.name))?;
            same_length(kernel.name, values.len(), expected.len())?;
            for (component, (value, expected)) in values.iter().zip(expected).enumerate() {
                count += 1;
                let figure = error_over_scale(*value, expected.value, expected.scale);
                worst.see(figure, || format!("{}, component {component}, point {index}: {value:e}", kernel.name));
            }
        }
    }
    Ok([rational, finish(worst, count)?])
}

fn finish(worst: Worst, count: usize) -> Result<Comparison, String> {
    nonempty(count)?;
    let measured = worst.finish()?;
    Ok(Comparison { count, figure: measured.figure, detail: format!("{count} values; worst in {}", measured.detail) })
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

fn same_names<'a>(
    kind: &str,
    in_file: impl Iterator<Item = &'a String>,
    kernels: impl Iterator<Item = &'static str>,
) -> Result<(), String> {
    let in_file: BTreeSet<&str> = in_file.map(String::as_str).collect();
    let kernels: BTreeSet<&str> = kernels.collect();
    let one_sided: Vec<_> = in_file.symmetric_difference(&kernels).collect();
    if one_sided.is_empty() { Ok(()) } else { Err(format!("{kind} quantities on one side only: {one_sided:?}")) }
}

fn same_length(name: &str, ours: usize, theirs: usize) -> Result<(), String> {
    if ours == theirs { Ok(()) } else { Err(format!("{name} has {ours} components here and {theirs} in the file")) }
}

fn nonempty(count: usize) -> Result<(), String> {
    if count > 0 { Ok(()) } else { Err("nothing was compared".into()) }
}
