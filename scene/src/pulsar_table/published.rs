//! Values printed in the paper for our pulsars, and limits published by others, for comparison with ours.

use super::{Pulsar, paper};

/// Values that the paper prints for one pulse, in addition to its observations.
#[derive(Debug, Clone, Copy)]
pub struct PrintedBounds {
    /// Change of `lambda` (1e-3 deg).
    pub lambda_change: &'static str,
    /// Bound in 1e-16 with the factor eta left out.
    pub bound: &'static str,
    /// Bound in 1e-16 with eta = 10.
    pub conservative: &'static str,
}

/// The last rows of the paper's table, a column per pulse.
const PRINTED: [(&str, PrintedBounds); 3] = [
    ("PSR B1937+21, main pulse", PrintedBounds { lambda_change: "-19", bound: "100", conservative: "1000" }),
    ("PSR B1937+21, interpulse", PrintedBounds { lambda_change: "-5.2", bound: "10", conservative: "100" }),
    ("PSR J1744-1134", PrintedBounds { lambda_change: "1.6", bound: "1", conservative: "10" }),
];

/// The pulses of the paper's table with the values that it prints for them.
pub fn printed_bounds() -> Vec<(Pulsar, PrintedBounds)> {
    let printed = |pulsar: Pulsar| {
        let (_, printed) = PRINTED.iter().find(|(name, _)| *name == pulsar.name).expect("a column for each pulse");
        (pulsar, *printed)
    };
    paper().into_iter().map(printed).collect()
}

/// A published limit, as given in a line of `pulsars/published.tsv`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Published {
    /// The quantity that is limited; components are those of the Sun-centred frame.
    pub quantity: &'static str,
    /// The limit, or half the width of the interval.
    pub limit: f64,
    /// Meaning of the limit.
    pub meaning: &'static str,
    /// Authors, year and publication.
    pub source: &'static str,
    /// How much of the source was seen when the table was made: `abstract`, the number is in the abstract, which was read;
    /// `second-hand`, the number is known from others, and the publication could not be opened.
    pub seen: &'static str,
}

/// All published limits.
pub fn published() -> impl Iterator<Item = Published> {
    include_str!("../../pulsars/published.tsv").lines().skip(1).map(|line| {
        let cells: Vec<_> = line.split('\t').collect();
        let [quantity, limit, meaning, source, seen] = cells[..] else { panic!("five cells in `{line}`") };
        Published { quantity, limit: limit.parse().expect("a number"), meaning, source, seen }
    })
}

/// The limit published in a paper that gives only one, by the paper's arXiv number.
pub fn limit_of(paper: &str) -> f64 {
    published().find(|limit| limit.source.ends_with(paper)).expect("a published limit").limit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pulsar_table::{CONSERVATIVE_ETA, ROUND_INERTIA_OVER_C};

    #[test]
    fn limits_begin_with_the_first_line_below_the_header() {
        let first = published().next().unwrap();
        assert_eq!((first.quantity, first.limit), ("s^XX + s^YY - 2 s^ZZ", 4.1e-11));
        assert!(published().all(|limit| limit.limit > 0.0));
    }

    /// The paper prints powers of ten: the same order of magnitude (`docs/discrepancies.md`).
    #[test]
    fn the_round_numbers_of_the_paper_give_its_bounds() {
        for (pulsar, printed) in printed_bounds() {
            let [bound, conservative]: [f64; 2] =
                [printed.bound, printed.conservative].map(|text| text.parse().unwrap());
            assert_eq!(conservative / bound, CONSERVATIVE_ETA);
            let found = pulsar.bound_over_eta(ROUND_INERTIA_OVER_C).unwrap();
            assert!((found / (bound * 1e-16)).log10().abs() < 1.0, "{}: {found:e}", pulsar.name);
        }
    }
}
