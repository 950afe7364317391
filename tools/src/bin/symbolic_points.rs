//! Writes the kernel values at random rational points, for `python3 verify/oracles/symbolic compare`: the points as exact fractions, each value as
//! the shortest decimal that identifies its double, and the sum of the magnitudes of its terms.
//!
//! ```text
//! cargo run -p twofold-tools --bin symbolic_points -- FILE [POINTS] [SEED]
//! ```

use std::collections::BTreeMap;

use serde_json::{Value, json};
use twofold_verify::random::Random;
use twofold_verify::symbolic::{DATA, Document, closed_kernels, rational_kernels};

fn main() -> Result<(), String> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("the file to write is missing")?;
    let mut number = |default: u64| {
        arguments.next().map_or(Ok(default), |text| text.parse::<u64>().map_err(|error| format!("{text}: {error}")))
    };
    let (count, seed) = (number(100)?, number(1)?);
    let layout = Document::parse(DATA)?.layout;
    let mut random = Random::with_seed(seed);
    let points: Vec<_> = (0..count).map(|_| layout.draw(&mut random)).collect();
    let mut rational = BTreeMap::new();
    for kernel in rational_kernels() {
        let rows = points.iter().map(|point| {
            let values = (kernel.doubles)(&layout.coded(point));
            let scales = (kernel.conditioned)(&layout.coded(point));
            values.into_iter().zip(scales).map(|(value, scale)| [value, scale.magnitude]).collect::<Vec<_>>()
        });
        rational.insert(kernel.name, rows.collect::<Vec<_>>());
    }
    let mut closed: BTreeMap<&str, Vec<Value>> = BTreeMap::new();
    for kernel in closed_kernels() {
        // A refusal is written as its message, which fails the comparison.
        let rows = points.iter().map(|point| match (kernel.values)(&layout.coded(point)) {
            Ok(values) => json!(values),
            Err(error) => json!(error.to_string()),
        });
        closed.insert(kernel.name, rows.collect());
    }
    let points: Vec<BTreeMap<_, _>> =
        points.iter().map(|point| point.iter().map(|(name, (n, d))| (name, format!("{n}/{d}"))).collect()).collect();
    let written = json!({ "seed": seed, "points": points, "rational": rational, "closed": closed });
    std::fs::write(&file, written.to_string()).map_err(|error| format!("{file}: {error}"))
}
