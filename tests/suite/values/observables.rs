//! Pulses, arrivals, clocks, distributions and stars.

use twofold::dynamics::BodyState;
use twofold::observables::Observer;
use twofold::observables::eta_distribution::{EtaDistribution, root_mean_square_along_motion};
use twofold::observables::pulsar::period::{
    approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period,
};
use twofold::observables::pulsar::rate_bounds::rate_bounds;
use twofold::observables::pulsar::{Beam, PulsarClock, PulseTrain, arrivals, propagated_pulse_train, pulse_train};
use twofold::propagation::propagate;
use twofold::solutions::averaged::AveragingOrder;
use twofold::star::axisymmetric::axisymmetric_integrals;
use twofold::star::maclaurin::MaclaurinSpheroid;
use twofold::star::uniform_spheroid::UniformSpheroid;

use crate::values::scene::{PROLATE, STAR, beam, general, observer, state};
use crate::values::table::Table;

fn train(table: &mut Table, name: &str, train: &PulseTrain) {
    for pulse in &train.pulses {
        table.parts(&format!("{name}: pulse"), [pulse.start, pulse.end, pulse.midpoint(), pulse.duration()]);
        table.text(
            &format!("{name}: cut, whole"),
            &format!("{} {} {}", pulse.cut_at_start, pulse.cut_at_end, pulse.is_whole()),
        );
    }
    table.parts(&format!("{name}: grazings"), train.grazings.iter().copied());
    for period in train.periods().chain(train.durations()) {
        table.parts(&format!("{name}: period or duration"), [period.time, period.value]);
    }
}

#[test]
fn pulses() {
    let mut table = Table::default();
    let span = (0.0, 60.0);
    let motion = propagate(&STAR, &general(), &state(), span, 1e-12).expect("a motion");
    let beams = [
        ("usual", beam(), observer()),
        ("narrow", Beam::new(0.8, -0.3, 0.05), Observer::at(1.0, 0.2)),
        ("wide", Beam::new(0.6, 0.0, 1.2), Observer::at(0.5, 0.0)),
        ("near n", Beam::new(0.1, 0.0, 0.3), Observer::at(1.3, 2.0)),
        ("behind", Beam::new(2.6, 0.0, 0.4), Observer::at(2.2, -1.0)),
    ];
    for (name, beam, observer) in &beams {
        let o = &observer.direction;
        match pulse_train(&motion, beam, o, span) {
            Ok(found) => {
                train(&mut table, name, &found);
                match arrivals(&motion, beam, o, &found) {
                    Ok(arrivals) => {
                        for arrival in arrivals {
                            table.parts(
                                &format!("{name}: arrival"),
                                [arrival.number as f64, arrival.midpoint, arrival.closest_approach],
                            );
                        }
                    }
                    Err(error) => table.error(name, &error),
                }
            }
            Err(error) => table.error(name, &error),
        }
        for (s, accuracy) in [(general(), 1e-9), (general() * 0.0, 1e-9)] {
            match propagated_pulse_train(&STAR, &s, &state(), (0.0, 21.0), accuracy, beam, o) {
                Ok((found, end)) => {
                    train(&mut table, &format!("{name}, propagated"), &found);
                    for state in &end.states {
                        table.state(&format!("{name}, end"), state);
                    }
                    table.parts(&format!("{name}, steps and order"), [end.step_count as f64, end.order as f64]);
                }
                Err(error) => table.error(name, &error),
            }
        }
    }
    let bounds = rate_bounds(&STAR, &general(), &state());
    table.parts("bounds of rates", [bounds.first, bounds.third]);
    table.check("pulses");
}

#[test]
fn clocks() {
    let mut table = Table::default();
    let reversed = BodyState { momentum: -state().momentum, ..state() };
    let beams = [
        ("usual", Beam::new(1.25, 0.4, 0.5), Observer::at(0.95, 0.35)),
        ("near n", Beam::new(0.1, 0.0, 0.9), Observer::at(1.0, 0.5)),
        ("wide", Beam::new(1.2, 0.0, 1.0), Observer::at(1.0, 0.0)),
        ("behind", Beam::new(2.9, 0.0, 0.9), Observer::at(2.2, -1.0)),
    ];
    for (of, star, s, initial) in [
        ("general", STAR, general() * 0.1, state()),
        ("weak", STAR, general() * 1e-8, state()),
        ("none", STAR, general() * 0.0, state()),
        ("reversed", STAR, general() * 0.1, reversed),
        ("prolate", PROLATE, general() * 0.1, state()),
    ] {
        for (name, beam, observer) in &beams {
            for order in [AveragingOrder::First, AveragingOrder::Second] {
                if order == AveragingOrder::First && of != "general" {
                    continue;
                }
                let name = format!("{of}, {name}, {order:?}");
                let mut clock = match PulsarClock::new(&star, &s, &initial, beam, observer, order) {
                    Ok(clock) => clock,
                    Err(error) => {
                        table.error(&name, &error);
                        continue;
                    }
                };
                table.number(&format!("{name}: period"), clock.period());
                table.number(&format!("{name}: truncation"), clock.truncation(40.0));
                for t in [[0.0, 0.0], [12.0, 0.3], [31.0, 0.0], [5e3, 0.25], [-250.0, 0.0], [30.0, 0.0]] {
                    match clock.pulse_near(t) {
                        Ok(Some(pulse)) => {
                            let at = [pulse.number as f64, pulse.midpoint[0] + pulse.midpoint[1], pulse.duration];
                            table.parts(&format!("{name} near {t:?}"), at);
                            table.parts(
                                &format!("{name} near {t:?}: angle, rate, swing"),
                                [pulse.position_angle, pulse.position_angle_rate, pulse.swing],
                            );
                            table.parts(
                                &format!("{name} near {t:?}: state"),
                                [pulse.state.axis.x, pulse.state.momentum.y, pulse.state.equatorial_axis.z],
                            );
                        }
                        Ok(None) => table.text(&format!("{name} near {t:?}"), "dark"),
                        Err(error) => table.error(&format!("{name} near {t:?}"), &error),
                    }
                    let near = clock.near(t).state(0.5);
                    table.parts(
                        &format!("{name}, state near {t:?}"),
                        [near.axis.z, near.momentum.x, near.equatorial_axis.y],
                    );
                }
            }
        }
    }
    table.check("clocks");
}

#[test]
fn periods_and_distributions() {
    let mut table = Table::default();
    let omega = nalgebra::Vector3::new(0.3, -0.2, 1.7);
    let rate = azimuth_rate(&state().axis, &omega);
    table.parts("azimuth rate", [rate, instantaneous_period(rate)]);
    let offset = azimuth_offset_rate(0.8, 0.3, 1.1, 0.6, 0.2);
    table.parts("offset rate", [offset, approximate_period(1.3, offset)]);
    for ratio in [-0.9, 0.3, 2.5] {
        for (name, found) in [
            ("at an inclination", EtaDistribution::at_inclination(ratio, 0.7)),
            ("at a constant", EtaDistribution::at_constant(ratio, 0.7)),
            ("of an unknown axis", EtaDistribution::of_unknown_axis(ratio)),
            ("at a known angle", EtaDistribution::at_inclination(ratio, 0.7).and_then(|eta| eta.seen_at(2.0))),
        ] {
            match found {
                Ok(found) => {
                    let quantiles = [0.05, 0.5, 0.95].map(|p| found.quantile(p).unwrap_or(f64::NAN));
                    table.parts(
                        &format!("eta {name}, {ratio}: mean square, above 1, quantiles"),
                        [
                            found.root_mean_square(),
                            found.probability_above(1.0),
                            quantiles[0],
                            quantiles[1],
                            quantiles[2],
                        ],
                    );
                }
                Err(error) => table.error(&format!("eta {name}, {ratio}"), &error),
            }
        }
        table.number(&format!("eta along the motion, {ratio}"), root_mean_square_along_motion(ratio, 0.7));
    }
    table.check("periods_and_distributions");
}

#[test]
fn stars() {
    let mut table = Table::default();
    let dense = |r: f64, mu: f64| 1.2 - r * r * (0.5 + 0.2 * mu * mu);
    let surface = |mu: f64| (1.0 + 0.1 * mu * mu, 0.2 * mu);
    for degree in [4, 8, 12] {
        let found = axisymmetric_integrals(&(dense, surface), degree).expect("integrals");
        table.number(&format!("degree {degree}: mass"), found.mass);
        table.number(&format!("degree {degree}: C"), found.c);
        table.number(&format!("degree {degree}: error of C"), found.c_error);
        table.number(&format!("degree {degree}: I^xx"), found.moment_of_inertia.xx);
        table.number(&format!("degree {degree}: I^zz"), found.moment_of_inertia.zz);
        table.number(&format!("degree {degree}: U^xx"), found.potential_energy_tensor.xx);
        table.number(&format!("degree {degree}: U^zz"), found.potential_energy_tensor.zz);
    }
    let spheroid = UniformSpheroid::from_semi_axes(1.3, 0.9, 0.7).expect("a spheroid");
    let found = axisymmetric_integrals(&spheroid, 8).expect("integrals");
    table.number("uniform: C", found.c);
    table.number("uniform: error of C", found.c_error);
    let star = MaclaurinSpheroid::new(spheroid).expect("a spheroid");
    table.number("pressure in the centre", star.central_pressure);
    table.number("pressure", star.pressure(0.4, 0.3));
    table.number("pressure on the axis", star.pressure(0.0, 0.7));
    table.number("pressure integral", star.pressure_integral);
    table.check("stars");
}
