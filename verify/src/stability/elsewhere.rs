//! Public functions without a case, with the reason.

/// Paths (a type for all of its methods) and the reason why no sweep measures them.
pub const ELSEWHERE: &[(&[&str], &str)] = &[
    (
        &[
            "propagation::propagate",
            "propagation::propagate_axis",
            "propagation::states_at",
            "propagation::axis_states_at",
            "propagation::axis_states_of_many",
            "propagation::states_of_many",
            "dynamics::Problem",
            "propagation::TaylorMotion",
            "propagation::splitting",
            "propagation::ContinuousAngles",
        ],
        "numerical motion: its error grows with time and is that of a method, not of a formula; against 34 digits in `propagation-*`, `splitting-*` \
         and in the tables of long times",
    ),
    (
        &["curvature_coupling::coefficients_from_vacuum_value"],
        "sums of at most seven of the given numbers with factors 1, 1/4 and 2, whose error is that of the sums; `coupling-to-curvature-rounding` measures it",
    ),
    (
        &[
            "propagation::AveragedMotion",
            "propagation::SymmetricMotion",
            "propagation::UniformMotion",
            "solutions::averaged::AveragedSolution::near",
            "solutions::averaged::AveragedSolution::with_free_rotation_of",
            "solutions::averaged::AveragedSolution::phases",
            "solutions::averaged::AveragedSolution::phases_at",
            "solutions::averaged::AveragedSolution::state",
            "solutions::averaged::AveragedSolution::state_at",
        ],
        "closed motions over a span, made of the kernels `free_rotation`, `SymmetricSolution`, `Top`, `AveragedSolution::rates` and `turns` here; as \
         motions against 34 digits in `mean-*` and `propagation-*`",
    ),
    (
        &[
            "solutions::averaged::AveragedSolution::order",
            "solutions::averaged::AveragedSolution::relative_strength",
            "solutions::averaged::AveragedSolution::require_derivatives",
            "solutions::averaged::AveragedSolution::error_estimate",
            "solutions::averaged::AveragedSolution::rounding",
            "solutions::averaged::AveragedSolution::truncation",
            "propagation::largest_torque",
            "propagation::taylor_forecast",
            "observables::pulsar::rate_bounds::rate_bounds",
            "observables::pulsar::PulsarClock::truncation",
        ],
        "estimates and bounds: they must not be too small, and no digit of theirs counts; checks of estimates and coverage",
    ),
    (&["plan"], "decides what is computed, by integers and estimates; derivatives of motions in `gradient-*`"),
    (
        &[
            "observables::pulsar::train",
            "observables::pulsar::arrival::arrivals",
            "observables::pulsar::Pulse",
            "observables::pulsar::PulseTrain",
            "observables::pulsar::PulsarClock",
            "observables::pulsar::NearState",
        ],
        "searches for edges, made of `Beam::margin_rates` here; their times against 30 digits in `pulse-edges-reference`, grazing in `pulse-train-grazing`",
    ),
    (
        &["observables::pulsar::ConstantPeriod", "observables::pulsar::SpinFit"],
        "least squares: the error is that of the data",
    ),
    (
        &["observables::spectrum", "observables::fundamental_frequencies"],
        "estimates from samples, whose error is that of the window; against exact frequencies in `mean-frequency-*` and `line-*`",
    ),
    (
        &[
            "observables::eta_distribution::EtaDistribution::at_inclination",
            "observables::eta_distribution::EtaDistribution::at_constant",
            "observables::eta_distribution::EtaDistribution::of_unknown_axis",
            "observables::eta_distribution::root_mean_square_along_motion",
        ],
        "averages over 256 nodes of kernels here: the error is that of the rule, see `eta-*`",
    ),
    (
        &["observables::eta_distribution::EtaDistribution::seen_at"],
        "one sine; quantiles are bisected to the last digit, against closed forms in the tests of the module",
    ),
    (
        &[
            "dynamics::RigidSpheroid::in_units_of_tc",
            "dynamics::RigidSpheroid::inertia",
            "dynamics::RigidSpheroid::map",
            "euler_angles::permuted_from_inertial",
            "scalar::constant_vector",
            "scalar::real_part",
            "solutions::averaged::Top::goes_round",
            "solutions::averaged::Top::is_periodic",
            "solutions::perturbation::Precession::sign",
            "error::Error",
        ],
        "no arithmetic: what was given, signs, yes or no",
    ),
    (
        &[
            "dynamics::potential::anisotropic_potential",
            "dynamics::AxisState",
            "scalar::length",
            "solutions::averaged::Top::complement",
            "solutions::averaged::Top::squares",
            "solutions::averaged::Turns",
        ],
        "one product, one root, or a product with a matrix as in `BodyState::rotated`",
    ),
    (&["observables::gravitational_wave::wave_of_state"], "three kernels here, one after the other"),
    (&["star::maclaurin::MaclaurinSpheroid::virial_residual"], "zero but for rounding, see `star-tensor-virial`"),
];
