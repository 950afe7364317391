//! Statements of Section III and the conclusion: bounds, pulsar signals, gravitational waves.

use super::Claim;
use super::Verdict::{Confirmed, Corrected, NotReproduced};

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "changes-proportional",
        place: "Sec. III A, Eqs. (38), (39)",
        statement: "The changes of alpha, beta and cos lambda in the interval between two observations are those of the rates at its start.",
        verdict: Corrected,
        finding: "The terms in A are an oscillation with the frequency omega: they count for intervals well below a turn of the \
                  star, and average out over years.",
        checks: &["spin-axis-changes-order-in-time", "spin-axis-changes-order-in-s", "spin-axis-changes-oscillation"],
        golden: &[],
    },
    Claim {
        id: "lambda-row",
        place: "Sec. III A, table, row of Delta lambda",
        statement: "(42) and the rows above give changes of lambda of -19, -5.2 and 1.6 thousandths of a degree.",
        verdict: Confirmed,
        finding: "With lambda counted from the direction from the observer to the star.",
        checks: &["pulsar-angle-changes"],
        golden: &["pulsar_bounds"],
    },
    Claim {
        id: "bound-rows",
        place: "Sec. III A, table, last two rows",
        statement: "The bounds are 1e-14, 1e-15 and 1e-16 times eta, and ten times these with eta = 10.",
        verdict: NotReproduced,
        finding: "4.8e-14, 1.3e-14 and 1.6e-15 times eta; with the round I^zz/C = 1e-5 s^2, 2.7e-14, 7.4e-15 and 8.8e-16. The \
                  printed powers of ten are rounded down, and are stronger bounds than the data give.",
        checks: &["pulsar-bounds-rounded-down"],
        golden: &["pulsar_bounds"],
    },
    Claim {
        id: "inertia-estimate",
        place: "Sec. III A, Eq. (43)",
        statement: "I^zz/C ~ 1e-5 s^2 at 1e15 g/cm^3 and an oblateness of 1e-3.",
        verdict: Confirmed,
        finding: "1.79e-5 s^2. That oblateness is the centrifugal one at 70 Hz, not that of the two pulsars.",
        checks: &["star-estimate-magnitudes", "star-estimate-numbers"],
        golden: &["star_estimates"],
    },
    Claim {
        id: "absorbed-angles",
        place: "Sec. III B, below Eq. (47)",
        statement: "phi_o and delta can be absorbed in the initial values of alpha and gamma.",
        verdict: Corrected,
        finding: "delta can. phi_o can in the expression (47), but the motion itself depends on the initial alpha unless s^XX = s^YY.",
        checks: &["beam-azimuth-absorbed", "observer-azimuth-not-absorbed"],
        golden: &[],
    },
    Claim {
        id: "formulas-fit-tp-1",
        place: "Sec. III B, period and width series",
        statement: "(51) and (56) fit the series of periods and widths of tp-I very well.",
        verdict: Confirmed,
        finding: "",
        checks: &["pulse-series-fit-tp-1"],
        golden: &[],
    },
    Claim {
        id: "formulas-fail-tp-2",
        place: "Sec. III B, period and width series",
        statement: "(51) and (56) fail for tp-II.",
        verdict: Confirmed,
        finding: "",
        checks: &["pulse-series-fail-tp-2"],
        golden: &[],
    },
    Claim {
        id: "time-units",
        place: "Sec. III B, Eq. (58) and its footnote",
        statement: "t_c ~ 1 s for an oblateness of 1e-8 and 1e-3 s for 0.1, at 1e15 g/cm^3.",
        verdict: Confirmed,
        finding: "",
        checks: &["star-estimate-magnitudes", "star-estimate-numbers"],
        golden: &["star_estimates"],
    },
    Claim {
        id: "zimmermann-limit",
        place: "Sec. III C, Eq. (66)",
        statement: "Without a torque A^ij is Zimmermann's.",
        verdict: Confirmed,
        finding: "",
        checks: &["free-wave-tensor"],
        golden: &[],
    },
    Claim {
        id: "free-waveform",
        place: "Sec. III C, Eq. (68)",
        statement: "In free precession ddot I has the form (68).",
        verdict: Confirmed,
        finding: "",
        checks: &["free-wave-source", "wave-of-free-precession"],
        golden: &[],
    },
];
