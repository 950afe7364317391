//! Perturbation solutions and the exact solution about a symmetry axis.

use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::{
    Constants, Form, Perturbation, Precession, constants_from_initial_values, shifted_rates,
};
use twofold::solutions::symmetric::SymmetricSolution;

use crate::values::scene::{PROLATE, STAR};
use crate::values::table::Table;

#[test]
fn constants_of_integration() {
    let mut table = Table::default();
    for (strength, s) in [("weak", [0.021, -0.004, 0.009]), ("strong", [0.3, -0.1, 0.2])] {
        let s = PrincipalCoefficients::new(s);
        for kind in [Precession::Twofold, Precession::Single] {
            for (alpha_0, beta_0, amplitude, phase) in
                [(0.4, 0.9, 0.1, -1.1), (7.4, 2.2, 0.0, 0.0), (-1.0, 0.3, 0.05, 2.0)]
            {
                let constants = Constants { alpha_0, beta_0, amplitude, phase };
                let name = format!("{strength}, {kind:?}, beta_0 {beta_0}");
                table.found(
                    &name,
                    Perturbation::new(Form::Printed, kind, &STAR, &s, 1.9, &constants),
                    |table, solution| {
                        let initial = solution.at(0.0);
                        let angles = [initial.alpha, initial.beta];
                        table.row(&name, &[("angles", &angles), ("rates", &[initial.alpha_rate, initial.beta_rate])]);
                        let back = constants_from_initial_values(Form::Printed, kind, &STAR, &s, 1.9, &initial);
                        table.found(&name, back, |table, back| {
                            let Constants { alpha_0, beta_0, amplitude, phase } = back;
                            table.row("  back", &[("alpha_0, beta_0, A, phi", &[alpha_0, beta_0, amplitude, phase])]);
                        });
                    },
                );
                table.found(&name, shifted_rates(&STAR, &s, 1.9, beta_0), |table, found| {
                    table.row("  shifted", &[("alpha", &found.alpha), ("gamma", &found.gamma)]);
                });
            }
        }
    }
    table.check("constants_of_integration");
}

#[test]
fn about_a_symmetry_axis() {
    let mut table = Table::default();
    let starts = [(0.3, 1.1, -0.5), (-2.0, 0.01, 0.2), (0.3, 3.0, -0.5)];
    let rates = [(0.9, 0.2, 0.6), (0.9, 0.0, 0.6), (0.0, 0.0, 0.0), (-0.1, 0.0, 1.4), (0.0, 0.3, 0.0)];
    for (of, star, strength) in
        [("weak", STAR, 0.03), ("strong", STAR, -0.4), ("prolate", PROLATE, 0.03), ("none", STAR, 0.0)]
    {
        let s = PrincipalCoefficients::new([strength, strength, -2.0 * strength]);
        for (alpha, beta, gamma) in starts {
            let angles = EulerAngles { alpha, beta, gamma };
            for (alpha, beta, gamma) in rates {
                let rates = EulerRates { alpha, beta, gamma };
                let name = format!("{of}, beta {}, rates {alpha} {beta} {gamma}", angles.beta);
                table.found(&name, SymmetricSolution::new(&star, &s, &angles, &rates), |table, found| {
                    let (mean, (least, most)) = (found.mean_rates(), found.inclinations());
                    let mean = [mean.alpha, mean.gamma];
                    table.row(&name, &[("period", &found.period()), ("beta", &[least, most]), ("mean rates", &mean)]);
                    let (at, rates) = (found.angles(-40.0), found.rates(-40.0));
                    let (at, rates) = ([at.alpha, at.beta, at.gamma], [rates.alpha, rates.beta, rates.gamma]);
                    table.row("  at -40", &[("angles", &at), ("rates", &rates)]);
                });
            }
        }
    }
    table.check("about_a_symmetry_axis");
}
