//! Time and steps of the numerical motion of tp-II over T = 1000, by accuracy.
use std::time::Instant;
use twofold::propagation::{AxisMotion, AxisState, Motion, axis_states_at, propagate, propagate_axis, states_at};
use twofold_verify::paper_examples;
fn main() {
    let example = paper_examples::paper_examples()[1];
    let (spheroid, s) = (paper_examples::spheroid(), paper_examples::COEFFICIENTS.tensor());
    let start = example.initial_state().unwrap();
    let reference = propagate(&spheroid, &s, &start, (0.0, 1000.0), 1e-15).unwrap().state(1000.0).unwrap();
    println!("accuracy: axis ms, steps, order, error, ns/step; full ms, error");
    for k in 1..=8 {
        let accuracy = 10f64.powi(-2 * k);
        let time = |f: &dyn Fn()| {
            (0..30)
                .map(|_| {
                    let t = Instant::now();
                    f();
                    t.elapsed().as_secs_f64() * 1e3
                })
                .fold(f64::MAX, f64::min)
        };
        let axis = propagate_axis(&spheroid, &s, &AxisState::from(&start), (0.0, 1000.0), accuracy).unwrap();
        let full = propagate(&spheroid, &s, &start, (0.0, 1000.0), accuracy).unwrap();
        let a = time(&|| {
            std::hint::black_box(
                axis_states_at(&spheroid, &s, &AxisState::from(&start), 0.0, &[1000.0], accuracy).unwrap(),
            );
        });
        let f = time(&|| {
            std::hint::black_box(states_at(&spheroid, &s, &start, 0.0, &[1000.0], accuracy).unwrap());
        });
        let sample = time(&|| {
            for i in 0..1000 {
                std::hint::black_box(full.state(f64::from(i)).unwrap());
            }
        });
        let end = full.state(1000.0).unwrap();
        println!(
            "{accuracy:e}: {a:.4} ms, {} steps, order {}, {:.1e}, {:.0} ns/step; full {f:.4} ms {:.1e}; {:.1} ns a sample; estimate {:.1e}",
            axis.step_count(),
            axis.order(),
            (axis.axis_state(1000.0).unwrap().axis - reference.axis).amax(),
            a * 1e6 / axis.step_count() as f64,
            (end.equatorial_axis - reference.equatorial_axis).amax(),
            sample * 1e3,
            full.error_estimate(1000.0)
        );
    }
}
