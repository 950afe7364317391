//! Perturbation solutions and the exact solution about a symmetry axis.

use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::solutions::perturbation::{
    Constants, Form, Precession, constants_from_initial_values, initial_values, shifted_rates,
};
use twofold::solutions::symmetric::SymmetricSolution;

use crate::values::scene::{PROLATE, STAR};
use crate::values::table::Table;

#[test]
fn constants_of_integration() {
    let mut table = Table::default();
    for s in [[0.021, -0.004, 0.009], [0.3, -0.1, 0.2]].map(PrincipalCoefficients::new) {
        for kind in [Precession::Twofold, Precession::Single] {
            for constants in [
                Constants { alpha_0: 0.4, beta_0: 0.9, amplitude: 0.1, phase: -1.1 },
                Constants { alpha_0: 7.4, beta_0: 2.2, amplitude: 0.0, phase: 0.0 },
                Constants { alpha_0: -1.0, beta_0: 0.3, amplitude: 0.05, phase: 2.0 },
            ] {
                let name =
                    format!("{kind:?} {s:?} {constants:?}").chars().filter(|c| !c.is_whitespace()).collect::<String>();
                let initial = match initial_values(Form::Printed, kind, &STAR, &s, 1.9, &constants) {
                    Ok(initial) => initial,
                    Err(error) => {
                        table.error(&name, &error);
                        continue;
                    }
                };
                table.parts(
                    &format!("{name}: initial"),
                    [initial.alpha, initial.beta, initial.alpha_rate, initial.beta_rate],
                );
                match constants_from_initial_values(Form::Printed, kind, &STAR, &s, 1.9, &initial) {
                    Ok(back) => {
                        table.parts(&format!("{name}: back"), [back.alpha_0, back.beta_0, back.amplitude, back.phase])
                    }
                    Err(error) => table.error(&name, &error),
                }
                match shifted_rates(&STAR, &s, 1.9, constants.beta_0) {
                    Ok(found) => table.parts(&format!("{name}: shifted"), [found.alpha, found.gamma]),
                    Err(error) => table.error(&name, &error),
                }
            }
        }
    }
    table.check("constants_of_integration");
}

#[test]
fn about_a_symmetry_axis() {
    let mut table = Table::default();
    let angles = [
        EulerAngles { alpha: 0.3, beta: 1.1, gamma: -0.5 },
        EulerAngles { alpha: -2.0, beta: 0.01, gamma: 0.2 },
        EulerAngles { alpha: 0.3, beta: 3.0, gamma: -0.5 },
    ];
    let rates = [
        EulerRates { alpha: 0.9, beta: 0.2, gamma: 0.6 },
        EulerRates { alpha: 0.9, beta: 0.0, gamma: 0.6 },
        EulerRates { alpha: 0.0, beta: 0.0, gamma: 0.0 },
        EulerRates { alpha: -0.1, beta: 0.0, gamma: 1.4 },
        EulerRates { alpha: 0.0, beta: 0.3, gamma: 0.0 },
    ];
    for (star, strength) in [(STAR, 0.03), (STAR, -0.4), (PROLATE, 0.03), (STAR, 0.0)] {
        let s = PrincipalCoefficients::new([strength, strength, -2.0 * strength]);
        for angles in &angles {
            for rates in &rates {
                let name = format!(
                    "{strength} {:.2} {:.1} {:.1} {:.1} {:.1}",
                    angles.beta, rates.alpha, rates.beta, rates.gamma, star.inertia_xx
                );
                match SymmetricSolution::new(&star, &s, angles, rates) {
                    Ok(found) => {
                        table.parts(
                            &format!("{name}: period, inclinations"),
                            [found.period(), found.inclinations().0, found.inclinations().1],
                        );
                        let mean = found.mean_rates();
                        table.parts(&format!("{name}: mean rates"), [mean.alpha, mean.beta, mean.gamma]);
                        for t in [0.0, 3.0, -40.0] {
                            let (angles, rates) = (found.angles(t), found.rates(t));
                            table.parts(
                                &format!("{name} at {t}"),
                                [angles.alpha, angles.beta, angles.gamma, rates.alpha, rates.beta, rates.gamma],
                            );
                        }
                    }
                    Err(error) => table.error(&name, &error),
                }
            }
        }
    }
    table.check("about_a_symmetry_axis");
}
