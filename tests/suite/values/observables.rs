//! Pulses, arrivals, clocks, distributions and stars.

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, Problem};
use twofold::observables::Observer;
use twofold::observables::eta_distribution::{EtaDistribution, root_mean_square_along_motion};
use twofold::observables::pulsar::period::{
    approximate_period, azimuth_offset_rate, azimuth_rate, instantaneous_period,
};
use twofold::observables::pulsar::rate_bounds::rate_bounds;
use twofold::observables::pulsar::{Beam, PulsarClock, PulseTrain, arrivals, pulse_train};
use twofold::solutions::averaged::AveragingOrder;
use twofold::star::axisymmetric::axisymmetric_integrals;
use twofold::star::maclaurin::MaclaurinSpheroid;
use twofold::star::uniform_spheroid::UniformSpheroid;

use crate::values::scene::{PROLATE, STAR, beam, general, observer, state};
use crate::values::table::Table;

fn train(table: &mut Table, name: &str, train: &PulseTrain) {
    for pulse in &train.pulses {
        assert_eq!(pulse.is_whole(), !pulse.cut_at_start && !pulse.cut_at_end);
        let cut = [(pulse.cut_at_start, "at its start"), (pulse.cut_at_end, "at its end")];
        let cut: Vec<_> = cut.iter().filter(|(is_cut, _)| *is_cut).map(|(_, where_)| *where_).collect();
        table.row(
            &format!("{name}, pulse"),
            &[
                ("start", &pulse.start),
                ("end", &pulse.end),
                ("midpoint", &pulse.midpoint()),
                ("duration", &pulse.duration()),
                ("cut", &if cut.is_empty() { "nowhere".to_string() } else { cut.join(" and ") }),
            ],
        );
    }
    for time in &train.grazings {
        table.row(&format!("{name}, grazing"), &[("t", time)]);
    }
    for (what, found) in [("period", train.periods().collect::<Vec<_>>()), ("duration", train.durations().collect())] {
        for found in found {
            table.row(&format!("{name}, {what}"), &[("t", &found.time), ("is", &found.value)]);
        }
    }
}

#[test]
fn pulses() {
    let mut table = Table::default();
    let span = (0.0, 60.0);
    let motion =
        Problem::new(STAR, general(), state()).and_then(|problem| problem.taylor(span, 1e-12)).expect("a motion");
    for (name, beam, observer) in [
        ("usual", beam(), observer()),
        ("narrow", Beam::new(0.8, -0.3, 0.05), Observer::at(1.0, 0.2)),
        ("wide", Beam::new(0.6, 0.0, 1.2), Observer::at(0.5, 0.0)),
        ("near n", Beam::new(0.1, 0.0, 0.3), Observer::at(1.3, 2.0)),
        ("behind", Beam::new(2.6, 0.0, 0.4), Observer::at(2.2, -1.0)),
    ] {
        let o = &observer.direction;
        table.found(name, pulse_train(&motion, &beam, o, span), |table, found| {
            train(table, name, &found);
            table.found(name, arrivals(&motion, &beam, o, &found), |table, arrivals| {
                for arrival in arrivals {
                    table.row(
                        &format!("{name}, arrival {}", arrival.number),
                        &[("midpoint", &arrival.midpoint), ("closest approach", &arrival.closest_approach)],
                    );
                }
            });
        });
        for (what, s) in [("propagated", general()), ("free", general() * 0.0)] {
            let name = format!("{name}, {what}");
            let found = Problem::new(STAR, s, state())
                .and_then(|problem| problem.taylor_pulse_train((0.0, 21.0), 1e-9, &beam, o));
            table.found(&name, found, |table, (found, end)| {
                train(table, &name, &found);
                for state in &end.states {
                    table.row(&name, &[("steps", &end.step_count), ("order", &end.order), ("end", state)]);
                }
            });
        }
    }
    let bounds = rate_bounds(&STAR, &general(), &state());
    table.row("bounds of rates", &[("first", &bounds.first), ("third", &bounds.third)]);
    table.check("pulses");
}

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
    for (of, star, s, initial, orders) in [
        ("general", STAR, general() * 0.1, state(), &[AveragingOrder::First, AveragingOrder::Second][..]),
        ("weak", STAR, general() * 1e-8, state(), &[AveragingOrder::Second]),
        ("none", STAR, general() * 0.0, state(), &[AveragingOrder::Second]),
        ("reversed", STAR, general() * 0.1, reversed, &[AveragingOrder::Second]),
        ("prolate", PROLATE, general() * 0.1, state(), &[AveragingOrder::Second]),
    ] {
        for order in orders {
            for (name, beam, observer) in &beams[..if of == "general" { 4 } else { 2 }] {
                let name = format!("{of}, {name}, {order:?}");
                let clock = PulsarClock::new(&star, &s, &initial, beam, observer, *order);
                table.found(&name, clock, |table, mut clock| {
                    table.row(&name, &[("period", &clock.period()), ("truncation", &clock.truncation(40.0))]);
                    // In this order: the next pulse is looked for from the one before.
                    for t in [[12.0, 0.3], [5e3, 0.25], [-250.0, 0.0], [30.0, 0.0]] {
                        table.found(&name, clock.pulse_near(t), |table, pulse| {
                            let Some(pulse) = pulse else { return table.row("  dark", &[("near", &t)]) };
                            table.row(
                                &format!("  pulse {}", pulse.number),
                                &[
                                    ("t", &(pulse.midpoint[0] + pulse.midpoint[1])),
                                    ("duration", &pulse.duration),
                                    ("angle", &pulse.position_angle),
                                    ("rate", &pulse.position_angle_rate),
                                    ("swing", &pulse.swing),
                                    ("", &pulse.state),
                                ],
                            );
                        });
                        let near = clock.near(t).state(0.5);
                        table.row(
                            "  half later",
                            &[("n_z, L_x, e_y", &[near.axis.z, near.momentum.x, near.equatorial_axis.y])],
                        );
                    }
                });
            }
        }
    }
    table.check("clocks");
}

#[test]
fn periods_and_distributions() {
    let mut table = Table::default();
    let rate = azimuth_rate(&state().axis, &Vector3::new(0.3, -0.2, 1.7));
    table.row("azimuth", &[("rate", &rate), ("period", &instantaneous_period(rate))]);
    let offset = azimuth_offset_rate(0.8, 0.3, 1.1, 0.6, 0.2);
    table.row("offset", &[("rate", &offset), ("period", &approximate_period(1.3, offset))]);
    for ratio in [-0.9, 0.3, 2.5] {
        let inclined = || EtaDistribution::at_inclination(ratio, 0.7);
        for (name, found) in [
            ("at an inclination", inclined()),
            ("at a constant", EtaDistribution::at_constant(ratio, 0.7)),
            ("of an unknown axis", EtaDistribution::of_unknown_axis(ratio)),
            ("at a known angle", inclined().and_then(|eta| eta.seen_at(2.0))),
        ] {
            let name = format!("eta {name}, r {ratio}");
            table.found(&name, found, |table, found| {
                table.row(
                    &name,
                    &[
                        ("root mean square", &found.root_mean_square()),
                        ("above 1", &found.probability_above(1.0)),
                        ("5, 50, 95 %", &[0.05, 0.5, 0.95].map(|p| found.quantile(p).unwrap_or(f64::NAN))),
                    ],
                );
            });
        }
        let along = root_mean_square_along_motion(ratio, 0.7);
        table.row(&format!("eta along the motion, r {ratio}"), &[("root mean square", &along)]);
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
        let (inertia, energy) = (found.moment_of_inertia, found.potential_energy_tensor);
        table.row(
            &format!("degree {degree}"),
            &[
                ("mass", &found.mass),
                ("C", &found.c),
                ("+-", &found.c_error),
                ("I^xx, I^zz", &[inertia.xx, inertia.zz]),
                ("U^xx, U^zz", &[energy.xx, energy.zz]),
            ],
        );
    }
    let spheroid = UniformSpheroid::from_semi_axes(1.3, 0.9, 0.7).expect("a spheroid");
    let found = axisymmetric_integrals(&spheroid, 8).expect("integrals");
    table.row("uniform", &[("C", &found.c), ("+-", &found.c_error)]);
    let star = MaclaurinSpheroid::new(spheroid).expect("a spheroid");
    table.row(
        "pressure",
        &[
            ("in the centre", &star.central_pressure),
            ("inside", &star.pressure(0.4, 0.3)),
            ("on the axis", &star.pressure(0.0, 0.7)),
            ("integral", &star.pressure_integral),
        ],
    );
    table.check("stars");
}
