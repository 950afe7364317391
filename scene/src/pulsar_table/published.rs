//! What is printed of our pulsars in the paper, and limits that others have published, to stand beside ours.

use super::{Pulsar, paper};

/// What the paper prints of one pulse beside what was observed of it.
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

/// The pulses of the paper's table with what is printed of them.
pub fn printed_bounds() -> Vec<(Pulsar, PrintedBounds)> {
    let printed = |pulsar: Pulsar| {
        let (_, printed) = PRINTED.iter().find(|(name, _)| *name == pulsar.name).expect("a column for each pulse");
        (pulsar, *printed)
    };
    paper().into_iter().map(printed).collect()
}

/// What of a publication was seen here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen {
    /// The number stands in its abstract, which was read.
    Abstract,
    /// The number is known from others; the publication could not be opened.
    SecondHand,
}

impl Seen {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Seen::Abstract => "abstract",
            Seen::SecondHand => "second-hand",
        }
    }
}

/// A published limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Published {
    /// What is limited; components are those of the Sun-centred frame.
    pub quantity: &'static str,
    /// The limit, or half the width of the interval.
    pub limit: f64,
    /// What the limit is.
    pub meaning: &'static str,
    /// Who, when and where.
    pub source: &'static str,
    /// What of it was seen.
    pub seen: Seen,
}

/// Of the two pulsars of the paper's table together.
pub const SOLITARY_ALPHA_2: Published = published(
    "|alpha_2|, strong field",
    1.6e-9,
    "95 %",
    "two solitary pulsars: Shao et al. 2013, arXiv:1307.2552",
    Seen::Abstract,
);

/// Of 13 pulsar systems together, to which the paper compares its bounds.
pub const GLOBAL_2014: Published = published(
    "s^XX + s^YY - 2 s^ZZ",
    1.2e-10,
    "68 %",
    "13 pulsar systems: Shao 2014, arXiv:1402.6452",
    Seen::SecondHand,
);

const PULSARS_2024: &str = "12 pulsar systems: Dong, Wang, Shao 2024, arXiv:2311.11038";

/// All of them.
pub const PUBLISHED: &[Published] = &[
    of_2024("s^XX + s^YY - 2 s^ZZ", 4.1e-11),
    GLOBAL_2014,
    of_2024("s^XX - s^YY", 3.9e-11),
    published(
        "s^XX - s^YY",
        1.1e-11,
        "about 1 sigma",
        "lunar laser ranging: Bourgoin et al. 2017, arXiv:1706.06294",
        Seen::SecondHand,
    ),
    of_2024("s^XY", 1.2e-11),
    of_2024("s^XZ", 5.6e-12),
    of_2024("s^YZ", 1.1e-11),
    of_2024("s^TX", 2.9e-9),
    of_2024("s^TY", 3.3e-9),
    of_2024("s^TZ", 3.2e-9),
    published("|s^TT|", 1.6e-5, "95 %", "binary pulsars, frame of the CMB: Shao 2014, arXiv:1412.2320", Seen::Abstract),
    SOLITARY_ALPHA_2,
    published(
        "|alpha_2|, strong field",
        1.8e-4,
        "95 %",
        "two binary pulsars: Shao, Wex 2012, arXiv:1209.4503",
        Seen::Abstract,
    ),
    published(
        "|alpha_1 + 0.4e-5|, strong field",
        3.7e-5,
        "95 %; 3.1e-5 below",
        "PSR J1738+0333: Shao, Wex 2012, arXiv:1209.4503",
        Seen::Abstract,
    ),
];

const fn of_2024(quantity: &'static str, limit: f64) -> Published {
    published(quantity, limit, "about 1 sigma", PULSARS_2024, Seen::SecondHand)
}

const fn published(
    quantity: &'static str,
    limit: f64,
    meaning: &'static str,
    source: &'static str,
    seen: Seen,
) -> Published {
    Published { quantity, limit, meaning, source, seen }
}
