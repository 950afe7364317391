//! The file of exact values.

use serde_json::Value;

use super::RationalPoint;
use super::point::Coded;
use crate::prelude::*;

/// A range of fractions `n / denominator` with `low <= n <= high`, without zero, and for an angle without the right angle, which would hide a term.
type Range = (i32, i32, i32);

/// Names of angles and numbers with their ranges.
#[derive(Debug, Clone)]
pub struct Layout {
    angles: BTreeMap<String, Range>,
    numbers: BTreeMap<String, Range>,
}

/// An exact value as numerator and denominator in decimal digits, and the double nearest to it.
#[derive(Debug, Clone)]
pub(super) struct Exact {
    pub(super) text: String,
    pub(super) nearest: f64,
}

/// A value with 40 digits, rounded, and the scale of its error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounded {
    pub(super) value: f64,
    pub(super) scale: f64,
}

/// Points, and the values of each quantity at each point.
#[derive(Debug, Clone)]
pub struct Document {
    /// Names and ranges.
    pub layout: Layout,
    pub(super) points: Vec<BTreeMap<String, (i32, i32)>>,
    pub(super) exact: BTreeMap<String, Vec<Vec<Exact>>>,
    pub(super) rounded: BTreeMap<String, Vec<Vec<Rounded>>>,
}

impl Layout {
    /// A random point, drawn from the ranges in the order of the names.
    pub fn draw(&self, random: &mut Random) -> BTreeMap<String, (i32, i32)> {
        let mut fraction = |&(low, high, denominator): &Range, is_angle: bool| {
            let count = u64::from(high.abs_diff(low)) + 1;
            loop {
                // The bias is at most 49 of 2^64, which is negligible.
                let numerator = low + (random.word() % count) as i32;
                if numerator != 0 && !(is_angle && numerator.abs() == denominator) {
                    return (numerator, denominator);
                }
            }
        };
        let angles = self.angles.iter().map(|of| (of, true));
        let all = angles.chain(self.numbers.iter().map(|of| (of, false)));
        all.map(|((name, range), is_angle)| (name.clone(), fraction(range, is_angle))).collect()
    }

    /// A point over another type of numbers.
    pub fn coded<F: Coded>(&self, fractions: &BTreeMap<String, (i32, i32)>) -> RationalPoint<F> {
        RationalPoint::new(fractions, |name| self.angles.contains_key(name))
    }
}

impl Document {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// If something is missing or malformed.
    pub fn parse(text: &str) -> Result<Self, String> {
        let json: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let ranges = |kind: &str| {
            map(&json["layout"][kind], |range| match numbers(range)?[..] {
                [low, high, denominator] => Ok((low, high, denominator)),
                _ => Err(format!("{range} is no range")),
            })
        };
        let points = list(&json["points"], |point| map(point, fraction))?;
        let exact = map(&json["exact"], |rows| {
            list(rows, |row| {
                list(row, |pair| match (pair[0].as_str(), pair[1].as_f64()) {
                    (Some(text), Some(nearest)) => Ok(Exact { text: text.to_string(), nearest }),
                    _ => Err(format!("{pair} is no exact value")),
                })
            })
        })?;
        let rounded = map(&json["rounded"], |rows| {
            list(rows, |row| {
                list(row, |pair| match (pair[0].as_str().map(str::parse), pair[1].as_f64()) {
                    (Some(Ok(value)), Some(scale)) => Ok(Rounded { value, scale }),
                    _ => Err(format!("{pair} is no rounded value")),
                })
            })
        })?;
        Ok(Self { layout: Layout { angles: ranges("angles")?, numbers: ranges("numbers")? }, points, exact, rounded })
    }

    /// How many points there are.
    pub fn count(&self) -> usize {
        self.points.len()
    }
}

fn map<T>(value: &Value, read: impl Fn(&Value) -> Result<T, String>) -> Result<BTreeMap<String, T>, String> {
    let object = value.as_object().ok_or_else(|| format!("{value} is no object"))?;
    object.iter().map(|(name, value)| Ok((name.clone(), read(value)?))).collect()
}

fn list<T>(value: &Value, read: impl Fn(&Value) -> Result<T, String>) -> Result<Vec<T>, String> {
    value.as_array().ok_or_else(|| format!("{value} is no list"))?.iter().map(read).collect()
}

fn numbers(value: &Value) -> Result<Vec<i32>, String> {
    let number = |n: &Value| n.as_i64().and_then(|n| i32::try_from(n).ok()).ok_or_else(|| format!("{n} is no integer"));
    list(value, number)
}

/// `"n/d"` or `"n"`.
fn fraction(value: &Value) -> Result<(i32, i32), String> {
    let text = value.as_str().ok_or_else(|| format!("{value} is no fraction"))?;
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    match (numerator.parse(), denominator.parse()) {
        (Ok(n), Ok(d)) if d != 0 => Ok((n, d)),
        _ => Err(format!("{text} is no fraction of small integers")),
    }
}
