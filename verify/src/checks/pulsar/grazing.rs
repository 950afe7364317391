//! Pulses that the line of sight grazes. Eq. (44).

use super::cases::{Case, edges, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// with cos rho at an extremum of m.n, plus or minus 1e-10 to 1e-12, the short pulse (or gap) exists or does not, and lasts 2 sqrt(2 d /
    /// |f''|); with cos rho at the extremum, a grazing is reported
    Property "pulse-train-grazing" [44]: grazing_by_construction;
    AtMost(1e-2) "largest relative error of the short duration; infinite for a wrong number of edges";
    because "m.n - cos rho = 1e-12 has 4e-4 of rounding and of the motion's error; the next term of the duration is 1e-5";
}

const END: f64 = 20.0;

fn grazing_by_construction() -> Result<Measured, String> {
    worst_over_random_cases(46, 60, (END, 1e-14), |case| {
        largest_if_any((0..100).filter_map(|index| graze(case, index).transpose()))
    })
}

/// The figure of the extremum in an interval, if there is one.
fn graze(case: &Case, index: u32) -> Result<Option<f64>, String> {
    // An extremum by bisection of the rate.
    let (mut low, mut high) = (0.2 * f64::from(index), 0.2 * f64::from(index + 1));
    let rising = case.margin(low)[1] > 0.0;
    if (case.margin(high)[1] > 0.0) == rising {
        return Ok(None);
    }
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if (case.margin(middle)[1] > 0.0) == rising { low = middle } else { high = middle }
    }
    let [margin, _, second, _] = case.margin(low);
    let product = margin + case.beam.half_opening.cos();
    // Flat extrema and angles with rounded cosines are left to other tests.
    if second.abs() < 1e-2 || product.abs() > 0.95 {
        return Ok(None);
    }
    let with_offset = |offset: f64| {
        let beam = Beam { half_opening: (product + offset).acos(), ..case.beam };
        let span = ((low - 0.05).max(0.0), (low + 0.05).min(END));
        pulse_train(&case.motion, &beam, &case.observer, span)
    };
    if !with_offset(0.0)?.grazings.iter().any(|t| (t - low).abs() < 1e-5) {
        return Ok(Some(f64::INFINITY));
    }
    largest_if_any([1e-10, 1e-11, 1e-12, -1e-10, -1e-11, -1e-12].map(|offset: f64| {
        let found = edges(&with_offset(offset)?);
        // Edges near the extremum: two if cos rho lies on the side to which m.n curves.
        let near: Vec<f64> = found.into_iter().filter(|t| (t - low).abs() < 1e-3).collect();
        let crossing = (offset > 0.0) == (second > 0.0);
        Ok(match (crossing, near.as_slice()) {
            (true, [start, end]) => {
                let expected = 2.0 * (2.0 * offset.abs() / second.abs()).sqrt();
                ((end - start) / expected - 1.0).abs()
            }
            (false, []) => 0.0,
            _ => f64::INFINITY,
        })
    }))
}
