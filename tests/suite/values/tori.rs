//! Tori: states with given integrals, separatrices, exact frequencies; averages of motions about the middle axis.

use twofold::dynamics::first_integrals::{FirstIntegrals, first_integrals};
use twofold::dynamics::{BodyState, RigidSpheroid};
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
        let integrals = first_integrals(&star, &s.tensor(), &initial);
        let FirstIntegrals { energy, spin, clebsch } = integrals;
        table.parts(&format!("{name}: integrals"), [energy, spin, clebsch]);
        match states_with_integrals(&star, &s, &integrals) {
            Ok(found) => {
                table.text(&format!("{name}: round"), &format!("{:?}", found.round));
                for state in &found.states {
                    table.state(name, state);
                }
                if let Some([positive, negative]) = found.components() {
                    table.state(&format!("{name}, positive"), &positive);
                    table.state(&format!("{name}, negative"), &negative);
                }
            }
            Err(error) => table.error(name, &error),
        }
        match separatrix_motion(&star, &s, energy, spin) {
            Ok(state) => table.state(&format!("{name}, separatrix"), &state),
            Err(error) => table.error(&format!("{name}, separatrix"), &error),
        }
        for wrong in [
            FirstIntegrals { energy: -energy, ..integrals },
            FirstIntegrals { clebsch: 2.0 * clebsch, ..integrals },
            FirstIntegrals { spin: f64::NAN, ..integrals },
        ] {
            table.refusal(&format!("{name}, wrong"), &states_with_integrals(&star, &s, &wrong));
        }
        match slow_precession(&star, &s, &initial.momentum, &initial.axis) {
            Ok(found) => table.parts(&format!("{name}: slow precession"), [found.axis as f64, found.rate * 1e3]),
            Err(error) => table.error(&format!("{name}: slow precession"), &error),
        }
        for order in [AveragingOrder::First, AveragingOrder::Second] {
            match middle_axis_growth(&star, &s, energy, spin, order) {
                Ok(growth) => table.number(&format!("{name}: growth, {order:?}"), growth),
                Err(error) => table.error(&format!("{name}: growth, {order:?}"), &error),
            }
            match AveragedSolution::new(&star, &s, &initial, order) {
                Ok(mean) => {
                    let rates = mean.rates();
                    table.parts(&format!("{name}: mean rates"), [rates.slow, rates.about_momentum, rates.about_axis]);
                    for t in [0.0, 13.0, -800.0] {
                        table.state(&format!("{name}, {order:?} at {t}"), &mean.state(t));
                        let phases = mean.phases(t);
                        table
                            .parts(&format!("{name}: phases"), [phases.slow, phases.about_momentum, phases.about_axis]);
                        table.number(&format!("{name}: error estimate"), mean.error_estimate(t));
                    }
                }
                Err(error) => table.error(&format!("{name}: averaged motion"), &error),
            }
        }
    }
    table.number("period near the separatrix", period_near_separatrix(0.03, 1e-5).expect("a period"));
    table.check("states_on_tori");
}

#[test]
fn exact_frequencies() {
    let mut table = Table::default();
    for (name, star, s, initial) in scenes() {
        match torus_frequencies(&star, &s, &initial) {
            Ok(found) => {
                table.text(&format!("{name}: axis"), &found.axis.to_string());
                table.parts(&format!("{name}: slow"), [found.slow]);
                table.parts(
                    &format!("{name}: about L and n"),
                    [found.about_momentum.unwrap_or(f64::NAN), found.about_axis.unwrap_or(f64::NAN)],
                );
                table.text(
                    &format!("{name}: uncertainties below 1e-12"),
                    &format!("{:?}", found.uncertainty.map(|error| error < 1e-12)),
                );
            }
            Err(error) => table.error(name, &error),
        }
    }
    table.check("exact_frequencies");
}
