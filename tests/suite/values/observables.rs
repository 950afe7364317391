//! Clocks, spectral lines, periods and distributions.

use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::{BodyState, Problem};
use twofold::observables::Observer;
use twofold::observables::eta_distribution::{EtaDistribution, SpinAxis, root_mean_square_along_motion};
use twofold::observables::pulsar::period::{
    approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period,
};
use twofold::observables::pulsar::{Beam, ClockPulse, PulsarClock};
use twofold::observables::spectrum::QuasiPeriodicMotion;
use twofold::propagation::PhasedMotion;

use crate::values::scene::{PROLATE, STAR, general, problem, state};
use crate::values::table::Table;

#[test]
fn clocks() {
    let mut table = Table::default();
    let reversed = BodyState { momentum: -state().momentum, ..state() };
    let beams = [
        ("usual", Beam::new(1.25, 0.4, 0.5), Observer::at(0.95, 0.35)),
        ("behind", Beam::new(2.9, 0.0, 0.9), Observer::at(2.2, -1.0)),
        ("near n", Beam::new(0.1, 0.0, 0.9), Observer::at(1.0, 0.5)),
        ("wide", Beam::new(1.2, 0.0, 1.0), Observer::at(1.0, 0.0)),
    ];
    for (of, star, s, initial) in [
        ("general", STAR, general() * 0.1, state()),
        ("weak", STAR, general() * 1e-8, state()),
        ("none", STAR, general() * 0.0, state()),
        ("reversed", STAR, general() * 0.1, reversed),
        ("prolate", PROLATE, general() * 0.1, state()),
    ] {
        for (name, beam, observer) in &beams[..if of == "general" { 4 } else { 1 }] {
            let name = format!("{of}, {name}");
            let problem = Problem::new(star, s, initial).expect("a problem");
            let clock = PhasedMotion::averaged(&problem).and_then(|motion| PulsarClock::new(motion, beam, observer));
            table.found(&name, clock, |table, clock| {
                table.row(&name, format_args!("period {:?}, truncation {:?}", clock.period(), clock.truncation(40.0)));
                // In this order: the search for the next pulse starts from the previous one.
                for t in [[12.0, 0.3], [5e3, 0.25], [-250.0, 0.0], [30.0, 0.0]] {
                    // Midpoints as one double, whose last digits are rounding.
                    let pulse = clock.pulse_near(t).map(|pulse| pulse.map(|pulse| (pulse.midpoint[0], pulse)));
                    table.found("  pulse", pulse, |table, pulse| match pulse {
                        Some((midpoint, pulse)) => {
                            table.row("  pulse", ClockPulse { midpoint: [midpoint, 0.0], ..pulse })
                        }
                        None => table.row("  dark", t),
                    });
                }
                table.row("  half after 30", clock.near([30.0, 0.0])(0.5).expect("it does not slow down"));
            });
        }
    }
    table.check("clocks");
}

#[test]
fn lines() {
    let mut table = Table::default();
    for (name, s) in [("general", general() * 0.1), ("none", general() * 0.0)] {
        table.found(name, QuasiPeriodicMotion::new(&problem(s)), |table, motion| {
            for of in &motion.frequencies().all {
                table.row("frequency", format_args!("{} {:?}, turns {:?}", of.symbol, of.rate, of.turns));
            }
            let function = |state: &BodyState<f64>| Ok::<_, Error>([state.equatorial_axis.x * state.momentum.y, 1.0]);
            let list = motion.lines(1e-4, function).expect("lines");
            table.row(
                "list",
                format_args!("constant {:?}, {} lines above {:?}", list.constant, list.lines.len(), list.least),
            );
            for line in list.lines.iter().take(6) {
                let [frequency, amplitude, phase] = [line.frequency, line.amplitude, line.phase];
                table.row(
                    "  line",
                    format_args!(
                        "{} frequency {frequency:?}, amplitude {amplitude:?}, phase {phase:?}",
                        line.combination
                    ),
                );
            }
        });
    }
    table.check("lines");
}

#[test]
fn periods_and_distributions() {
    let mut table = Table::default();
    let rate = azimuth_rate(&state().axis, &Vector3::new(0.3, -0.2, 1.7));
    table.row("azimuth", format_args!("rate {rate:?}, period {:?}", instantaneous_period(rate)));
    let offset = azimuth_offset_rate(0.8, 0.3, 1.1, 0.6, 0.2);
    table.row("offset", format_args!("rate {offset:?}, period {:?}", approximate_period(1.3, offset)));
    for ratio in [-0.9, 0.3, 2.5] {
        let inclined = || EtaDistribution::new(ratio, SpinAxis::AtInclination(0.7));
        for (name, found) in [
            ("at an inclination", inclined()),
            ("at a constant", EtaDistribution::new(ratio, SpinAxis::AtConstant(0.7))),
            ("of an unknown axis", EtaDistribution::new(ratio, SpinAxis::Unknown)),
            ("at a known angle", inclined().and_then(|eta| eta.seen_at(2.0))),
        ] {
            let name = format!("eta {name}, r {ratio}");
            table.found(&name, found, |table, found| {
                let (mean, above) = (found.root_mean_square(), found.probability_above(1.0));
                let quantiles = [0.05, 0.5, 0.95].map(|p| found.quantile(p).unwrap_or(f64::NAN));
                let text = format!("root mean square {mean:?}, above 1 {above:?}");
                table.row(&name, format_args!("{text}, 5, 50, 95 % {quantiles:?}"));
            });
        }
        let name = format!("eta along the motion, r {ratio}, root mean square");
        table.row(&name, root_mean_square_along_motion(ratio, 0.7));
    }
    table.check("periods_and_distributions");
}
