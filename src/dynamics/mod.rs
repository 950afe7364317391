//! Forces and equations of motion of a rigid body under Lorentz violation. Eqs. (2), (4), (11), (21)-(25), (59)-(68).

pub mod angular_acceleration;
pub mod euler_angle_equations;
pub mod first_integrals;
pub mod inertia;
pub mod inertia_tensor_rate;
pub mod kinetic_energy;
pub mod lagrangian;
pub mod point_masses;
pub mod potential;
mod problem;
pub mod regular_equations;
mod state;
pub mod torque;

pub use inertia::{PrincipalInertia, RigidSpheroid};
pub use problem::Problem;
pub(crate) use problem::check as check_problem;
pub use regular_equations::BodyState;
pub use state::{AxisState, RotationState};
