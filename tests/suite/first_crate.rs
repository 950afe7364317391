//! The crate outside the workspace, compiled and run here as well.

#[path = "../../examples/first-crate/src/main.rs"]
mod written_by_a_user;

#[test]
fn a_crate_outside_computes_a_motion_pulses_a_gradient_and_a_fit() {
    written_by_a_user::main().expect("it runs");
}
