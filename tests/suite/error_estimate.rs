//! The estimated error of a numerical motion is not below the true error, in 64 random scenes of `physical_domain::scenes`.

use proptest::prelude::*;
use twofold::plan::Method;
use twofold_verify::error_scenes::ErrorScene;
use twofold_verify::physical_domain::scenes;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn an_estimate_is_not_below_the_true_error(
        scene in scenes(),
        log_tolerance in -16.0..-2.0f64,
        end in -30.0..30.0f64,
        share in 0.0..1.0f64,
    ) {
        let problem = scene.problem();
        let scene = ErrorScene {
            problem,
            span: (0.0, end),
            time: end * share,
            tolerance: 10f64.powf(log_tolerance),
            strength: problem.coefficients().amax(),
            near_middle_axis: false,
            near_rest: false,
        };
        let (estimate, error) = scene.estimated_and_true(Method::Taylor).map_err(TestCaseError::fail)?;
        prop_assert!(estimate >= error, "estimated {estimate:e}, true {error:e}");
    }
}
