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
        table.found(name, principal_frame(&tensor), |table, frame| {
            let s = frame.coefficients;
            table.row(name, &[("values", &[s.xx, s.yy, s.zz])]);
            if name == "general" {
                let axes: Vec<_> = (0..3).map(|i| frame.principal_from_given.row(i).transpose()).collect();
                table.row("  axes", &[("X", &axes[0]), ("Y", &axes[1]), ("Z", &axes[2])]);
            }
        });
        for (how, found) in
            [("derivatives", principal_frame_with_derivatives(&seeded)), ("along", principal_frame_along(&seeded))]
        {
            table.found(&format!("{name}, {how}"), found, |table, (values, rotation)| {
                let all = [values.xx, values.yy, values.zz];
                // A principal axis has no sign, and with it no first column; what the frame makes of its own slope has none of these.
                let turning = rotation.map(|x| x.eps) * rotation.map(|x| x.re).transpose();
                let turning = [turning[(0, 1)], turning[(1, 2)], turning[(2, 0)]]
                    .map(|x: f64| if x.abs() < 1e4 { x.abs() } else { f64::INFINITY });
                table.row(&format!("  {how}"), &[("slopes", &all.map(|value| value.eps)), ("turning", &turning)]);
                let pair = (0..2).find(|&i| all[i].re == all[i + 1].re);
                if let (Some(i), "along") = (pair, how) {
                    assert!(all[i].eps >= all[i + 1].eps, "they stay in descending order as they part: {all:?}");
                }
            });
        }
        table.found(name, SymmetryOfTensor::of(&tensor), |table, found| {
            // An asymmetry of a rounding is none.
            let size = found.asymmetry.norm();
            table.row(
                "  symmetry",
                &[("difference", &found.difference), ("asymmetry", &(if size < 1e-15 { 0.0 } else { size }))],
            );
        });
    }
    let w = Vector3::new(1e-3, 2e-4, -3e-4);
    let s = coefficients_from_preferred_frame(2.5e-3, &w);
    table.row("preferred frame", &[("alpha_2", &preferred_frame_parameter(&s, &w).expect("of that form"))]);
    table.refusal("of no such form", preferred_frame_parameter(&tensor([0.02, 0.01, -0.03]), &w));
    table.check("principal_frames");
}

#[test]
fn units_epochs_and_turns() {
    let mut table = Table::default();
    table.row("unit", &[("seconds", &time_unit(3.7e-9).expect("a unit"))]);
    let epoch = Epoch::new(55_321, 0.375).expect("an epoch");
    for seconds in [[0.0, 0.0], [1.0, 1e-12], [54_000.0, 0.0], [-33_000.0, 1e-9], [1e9, -1e-7], [-1e10, 0.0]] {
        let after = epoch.after(seconds).expect("an epoch");
        let back = after.seconds_since(&epoch);
        table.row(&format!("after {seconds:?}"), &[("date", &after.to_string()), ("back", &(back[0] + back[1]))]);
    }
    for turn in [Vector3::new(0.3, -0.2, 0.9), Vector3::new(40.0, 3.0, -20.0), Vector3::new(1e-9, 0.0, -2e-9)] {
        table.row(&format!("turn {turn:?}"), &[("gives", &rotated_by(&turn, &Vector3::new(0.4, 1.1, -0.6)))]);
    }
    table.check("units_epochs_and_turns");
}
