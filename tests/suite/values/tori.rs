//! Tori: states with given integrals, separatrices, exact frequencies; averages of motions about the middle axis.

use twofold::dynamics::first_integrals::{FirstIntegrals, first_integrals};
use twofold::dynamics::{BodyState, Problem, RotationState};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::averaged::slow_precession::slow_precession;
use twofold::solutions::averaged::{AveragedSolution, AveragingOrder, middle_axis_growth, period_near_separatrix};
use twofold::solutions::torus::{separatrix_motion, states_with_integrals};

use crate::values::scene::{PROLATE, STAR, state};
use crate::values::table::Table;

#[test]
fn states_on_tori() {
    let mut table = Table::default();
    let other = BodyState { momentum: state().axis.cross(&state().momentum) + state().axis * 0.7, ..state() };
    for (name, star, s, initial) in [
        ("general", STAR, [0.021, -0.004, 0.009], state()),
        ("other order", STAR, [-0.004, 0.021, 0.009], state()),
        ("weak", STAR, [0.021e-3, -0.004e-3, 0.009e-3], state()),
        ("strong", STAR, [0.21, -0.04, 0.09], state()),
        ("other motion", STAR, [0.021, -0.004, 0.009], other),
        ("prolate", PROLATE, [0.021, -0.004, 0.009], state()),
        ("two equal", STAR, [0.02, 0.02, -0.03], state()),
        ("isotropic", STAR, [0.02, 0.02, 0.02], state()),
    ] {
        let s = PrincipalCoefficients::new(s);
        let problem = Problem::new(star, s.tensor(), initial).expect("a problem");
        let integrals = first_integrals(&star, &s.tensor(), &initial);
        let FirstIntegrals { energy, spin, clebsch } = integrals;
        table.row(name, integrals);
        table.found("  states", states_with_integrals(&star, &s, &integrals), |table, found| {
            table.row("  states", format_args!("round the axis {:?}", found.round));
            for state in found.states.iter().chain(found.components().iter().flatten()) {
                table.row("  state", state.axis_state());
            }
        });
        table.result("  separatrix", separatrix_motion(&star, &s, energy, spin).map(|state| state.axis_state()));
        for (what, wrong) in [
            ("-E", FirstIntegrals { energy: -energy, ..integrals }),
            ("2 K", FirstIntegrals { clebsch: 2.0 * clebsch, ..integrals }),
            ("no Omega^z", FirstIntegrals { spin: f64::NAN, ..integrals }),
        ] {
            table.result(&format!("  {what}"), states_with_integrals(&star, &s, &wrong).map(|_| "accepted"));
        }
        table.result("  slow precession", slow_precession(&star, &s, &initial.momentum, &initial.axis));
        for order in [AveragingOrder::First, AveragingOrder::Second] {
            let label = format!("  {order:?}");
            let growth = middle_axis_growth(&star, &s, energy, spin, order);
            table.result(&format!("{label}, growth about the middle axis"), growth);
            table.found(&label, AveragedSolution::new(&problem, order), |table, mean| {
                table.row(&label, format_args!("{:?}, strength {:?}", mean.rates(), mean.relative_strength()));
                table.row(
                    "  at 13",
                    format_args!("{:?}, error {:?}", mean.phases_at([13.0, 0.0]), mean.error_estimate(13.0)),
                );
                table.result(&format!("{label}, derivatives"), mean.require_derivatives());
            });
        }
    }
    table.result("period near the separatrix", period_near_separatrix(0.03, 1e-5));
    table.check("states_on_tori");
}
