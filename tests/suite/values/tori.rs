//! Tori: states with given integrals, separatrices, exact frequencies; averages of motions about the middle axis.

use twofold::dynamics::AxisState;
use twofold::dynamics::first_integrals::{FirstIntegrals, first_integrals};
use twofold::dynamics::{BodyState, Problem, RigidSpheroid};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::averaged::slow_precession::slow_precession;
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder, middle_axis_growth, period_near_separatrix};
use twofold::solutions::torus::{separatrix_motion, states_with_integrals, torus_frequencies};

use crate::values::scene::{PROLATE, STAR, state};
use crate::values::table::Table;

type Scene = (&'static str, RigidSpheroid<f64>, PrincipalCoefficients<f64>, BodyState<f64>);

fn scenes() -> Vec<Scene> {
    let s = |values: [f64; 3]| PrincipalCoefficients::new(values);
    let other = BodyState { momentum: state().axis.cross(&state().momentum) + state().axis * 0.7, ..state() };
    vec![
        ("general", STAR, s([0.021, -0.004, 0.009]), state()),
        ("other order", STAR, s([-0.004, 0.021, 0.009]), state()),
        ("weak", STAR, s([0.021e-3, -0.004e-3, 0.009e-3]), state()),
        ("strong", STAR, s([0.21, -0.04, 0.09]), state()),
        ("other motion", STAR, s([0.021, -0.004, 0.009]), other),
        ("prolate", PROLATE, s([0.021, -0.004, 0.009]), state()),
        ("two equal", STAR, s([0.02, 0.02, -0.03]), state()),
        ("isotropic", STAR, s([0.02, 0.02, 0.02]), state()),
    ]
}

#[test]
fn states_on_tori() {
    let mut table = Table::default();
    for (name, star, s, initial) in scenes() {
        let problem = Problem::new(star, s.tensor(), initial).expect("a problem");
        let integrals = first_integrals(&star, &s.tensor(), &initial);
        let FirstIntegrals { energy, spin, clebsch } = integrals;
        table.row(name, &[("E", &energy), ("Omega^z", &spin), ("K", &clebsch)]);
        table.found("  states", states_with_integrals(&star, &s, &integrals), |table, found| {
            table.row("  states", &[("round the axis", &found.round)]);
            for state in &found.states {
                table.row("  state", &[("", &AxisState::from(state))]);
            }
            if let Some([positive, negative]) = found.components() {
                table.row("  component", &[("positive", &AxisState::from(&positive))]);
                table.row("  component", &[("negative", &AxisState::from(&negative))]);
            }
        });
        table.found("  separatrix", separatrix_motion(&star, &s, energy, spin), |table, state| {
            table.row("  separatrix", &[("", &AxisState::from(&state))]);
        });
        for (what, wrong) in [
            ("-E", FirstIntegrals { energy: -energy, ..integrals }),
            ("2 K", FirstIntegrals { clebsch: 2.0 * clebsch, ..integrals }),
            ("no Omega^z", FirstIntegrals { spin: f64::NAN, ..integrals }),
        ] {
            table.refusal(&format!("  {what}"), states_with_integrals(&star, &s, &wrong));
        }
        let slow = slow_precession(&star, &s, &initial.momentum, &initial.axis);
        table.found("  slow precession", slow, |table, found| {
            table.row("  slow precession", &[("axis", &found.axis), ("rate", &found.rate)]);
        });
        for order in [AveragingOrder::First, AveragingOrder::Second] {
            let label = format!("  {order:?}");
            table.found(&label, middle_axis_growth(&star, &s, energy, spin, order), |table, growth| {
                table.row(&label, &[("growth about the middle axis", &growth)]);
            });
            table.found(&label, AveragedSolution::new(&problem, order), |table, mean| {
                let (rates, phases) = (&mean.rates, mean.phases_at([13.0, 0.0]));
                table.row(
                    &label,
                    &[
                        ("mean rates: slow", &rates.slow),
                        ("about L", &rates.about_momentum),
                        ("about n", &rates.about_axis),
                    ],
                );
                table.row(
                    &label,
                    &[
                        ("phases at 13", &[phases.slow, phases.about_momentum, phases.about_axis]),
                        ("error", &mean.error_estimate(13.0)),
                        ("", &mean.state(13.0)),
                    ],
                );
            });
        }
    }
    let period = period_near_separatrix(0.03, 1e-5).expect("a period");
    table.row("near the separatrix", &[("period", &period)]);
    table.check("states_on_tori");
}

#[test]
fn exact_frequencies() {
    let mut table = Table::default();
    for (name, star, s, initial) in scenes() {
        let problem = Problem::new(star, s.tensor(), initial).expect("a problem");
        table.found(name, torus_frequencies(&problem), |table, found| {
            table.row(
                name,
                &[
                    ("axis", &found.axis),
                    ("slow", &found.slow),
                    ("about L", &found.about_momentum),
                    ("about n", &found.about_axis),
                    ("uncertain", &!found.uncertainty.iter().all(|error| *error < 1e-12)),
                ],
            );
        });
    }
    table.check("exact_frequencies");
}
