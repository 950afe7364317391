//! Principal frames with derivatives, tensors nearly symmetric, units and epochs.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use twofold::epoch::Epoch;
use twofold::lorentz_violation::{
    SymmetryOfTensor, coefficients_from_preferred_frame, preferred_frame_parameter, principal_frame,
    principal_frame_along, principal_frame_with_derivatives,
};
use twofold::solutions::free::rotated_by;
use twofold::units::time_unit;

use crate::values::scene::tensor;
use crate::values::table::Table;

const SLOPE: Matrix3<f64> = Matrix3::new(0.3, -0.2, 0.5, -0.2, 0.1, 0.4, 0.5, 0.4, -0.4);

#[test]
fn principal_frames() {
    let mut table = Table::default();
    for (name, values) in [
        ("general", [0.021, -0.004, 0.009]),
        ("two equal", [0.02, 0.02, -0.03]),
        ("lower two equal", [0.02, -0.01, -0.01]),
        ("nearly equal", [0.02, 0.02 - 1e-10, -0.03]),
        ("not so nearly", [0.02, 0.02 - 1e-8, -0.03]),
        ("isotropic", [0.02; 3]),
    ] {
        let tensor = tensor(values);
        let seeded = tensor.zip_map(&SLOPE, Dual64::new);
        match principal_frame(&tensor) {
            Ok(frame) if name == "general" => table.matrix(&format!("{name}: frame"), &frame.principal_from_given),
            Ok(frame) => table.parts(
                &format!("{name}: values"),
                [frame.coefficients.xx, frame.coefficients.yy, frame.coefficients.zz],
            ),
            Err(error) => table.error(name, &error),
        }
        for (how, found) in
            [("derivatives", principal_frame_with_derivatives(&seeded)), ("along", principal_frame_along(&seeded))]
        {
            let name = format!("{name}, {how}");
            match found {
                Ok((values, rotation)) => {
                    let all = [values.xx, values.yy, values.zz];
                    table.parts(&format!("{name}: values"), all.map(|value| value.re));
                    table.parts(&format!("{name}: their slopes"), all.map(|value| value.eps));
                    // A principal axis has no sign, and with it no first column; what the frame makes of its own slope has none of these.
                    let turning = rotation.map(|x| x.eps) * rotation.map(|x| x.re).transpose();
                    table.parts(
                        &format!("{name}: turning"),
                        [turning[(0, 1)], turning[(1, 2)], turning[(2, 0)]]
                            .map(|x: f64| if x.abs() < 1e4 { x.abs() } else { f64::INFINITY }),
                    );
                    if let (Some(pair), true) = (equal(values.map_re()), how == "along") {
                        assert!(
                            all[pair].eps >= all[pair + 1].eps,
                            "they stay in descending order as they part: {all:?}"
                        );
                    }
                }
                Err(error) => table.error(&name, &error),
            }
        }
        match SymmetryOfTensor::of(&tensor) {
            Ok(found) => {
                table.parts(&format!("{name}: difference"), [found.difference]);
                table.text(
                    &format!("{name}: asymmetry"),
                    &format!("{:.3e}", if found.asymmetry.norm() < 1e-15 { 0.0 } else { found.asymmetry.norm() }),
                );
            }
            Err(error) => table.error(name, &error),
        }
    }
    let w = Vector3::new(1e-3, 2e-4, -3e-4);
    let s = coefficients_from_preferred_frame(2.5e-3, &w);
    table.number("alpha_2", preferred_frame_parameter(&s, &w).expect("of that form"));
    table.refusal("of no such form", &preferred_frame_parameter(&tensor([0.02, 0.01, -0.03]), &w));
    table.check("principal_frames");
}

trait Reals {
    fn map_re(&self) -> [f64; 3];
}

impl Reals for twofold::lorentz_violation::PrincipalCoefficients<Dual64> {
    fn map_re(&self) -> [f64; 3] {
        [self.xx.re, self.yy.re, self.zz.re]
    }
}

/// The first of two equal values.
fn equal(values: [f64; 3]) -> Option<usize> {
    (0..2).find(|&i| values[i] == values[i + 1])
}

#[test]
fn units_epochs_and_turns() {
    let mut table = Table::default();
    table.number("seconds", time_unit(3.7e-9).expect("a unit"));
    let epoch = Epoch::new(55_321, 0.375).expect("an epoch");
    for seconds in [[0.0, 0.0], [1.0, 1e-12], [54_000.0, 0.0], [-33_000.0, 1e-9], [1e9, -1e-7], [-1e10, 0.0]] {
        let after = epoch.after(seconds).expect("an epoch");
        table.text(&format!("after {seconds:?}"), &after.to_string());
        let back = after.seconds_since(&epoch);
        table.number(&format!("after {seconds:?}: back"), back[0] + back[1]);
    }
    for turn in [Vector3::new(0.3, -0.2, 0.9), Vector3::new(40.0, 3.0, -20.0), Vector3::new(1e-9, 0.0, -2e-9)] {
        table.parts(&format!("rotated by {turn:?}"), rotated_by(&turn, &Vector3::new(0.4, 1.1, -0.6)).iter().copied());
    }
    table.check("units_epochs_and_turns");
}
