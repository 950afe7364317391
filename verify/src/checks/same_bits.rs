//! Bitwise reproducibility: backwards compared with forwards with the momentum reversed, and in every run, order and thread.

use crate::prelude::*;

const SCENES: u64 = 60;
const SEED: u64 = 11;

checks! {
    /// free rotation, splitting and Taylor series at -t agree with those at t with L reversed, to the last bit
    Property "reversal-same-bits" [25]: reversal;
    AtMost(0.0) "states of random scenes that differ in a bit";
    because "the equations are reversible, and rounding does not depend on signs: any difference comes from a step, a threshold or a branch that does";
    /// every method gives the same states and error estimates again, in the other order and on two threads, to the last bit
    Property "threads-same-bits" [25]: threads;
    AtMost(0.0) "states of random scenes that differ in a bit";
    because "nothing is kept between motions";
}

fn scene(method: Method, number: u64) -> Option<ErrorScene> {
    let mut scene = ErrorScene::draw(SEED, number).for_method(method, number)?;
    let [duration, elapsed] = [scene.span.1, scene.time].map(|t| t - scene.span.0);
    (scene.span, scene.time) = ((0.0, duration), elapsed);
    Some(scene)
}

/// State and estimate, or the error of the method.
fn state_of(method: Method, scene: &ErrorScene) -> Result<(BodyState<f64>, f64), String> {
    let motion = scene.problem.motion_by(method, scene.span, scene.tolerance)?;
    Ok((motion.state(scene.time)?, motion.error_estimate(scene.time)))
}

fn reversal() -> Result<Measured, String> {
    let (mut different, mut seen) = (Vec::new(), 0);
    for method in [Method::Free, Method::Splitting, Method::Taylor] {
        for number in 0..SCENES {
            let Some(forwards) = scene(method, number) else { continue };
            let reversed = |state: &BodyState<f64>| BodyState { momentum: -state.momentum, ..*state };
            let backwards = ErrorScene {
                problem: forwards.problem.starting_from(reversed(forwards.problem.initial()))?,
                span: (0.0, -forwards.span.1),
                time: -forwards.time,
                ..forwards
            };
            let refused = |why| format!("{} refuses scene {number} of seed {SEED}: {why}", method.name());
            let (one, _) = state_of(method, &forwards).map_err(refused)?;
            let (other, _) = state_of(method, &backwards).map_err(refused)?;
            seen += 1;
            if one != reversed(&other) {
                different.push((method.name(), number));
            }
        }
    }
    Ok(Measured::new(different.len() as f64, format!("of {seen} of seed {SEED}; first {:?}", different.first())))
}

fn threads() -> Result<Measured, String> {
    let all: Vec<(Method, u64)> =
        Method::ALL.iter().flat_map(|m| (0..SCENES).map(move |number| (*m, number))).collect();
    let bits = |(method, number): &(Method, u64)| -> Option<Vec<u64>> {
        let (state, estimate) = state_of(*method, &scene(*method, *number)?).ok()?;
        Some(state.vectors().iter().flatten().chain([&estimate]).map(|x| x.to_bits()).collect())
    };
    let once: Vec<_> = all.iter().map(bits).collect();
    let (even, odd): (Vec<_>, Vec<_>) = all.iter().rev().partition(|(_, number)| number % 2 == 0);
    let worker = |part: Vec<&(Method, u64)>| part.into_iter().map(|which| (*which, bits(which))).collect::<Vec<_>>();
    let again = std::thread::scope(|scope| {
        let one = scope.spawn(|| worker(even.iter().collect()));
        let mut found = worker(odd.iter().collect());
        found.extend(one.join().map_err(|_| "a thread panicked".to_string())?);
        Ok::<_, String>(found)
    })?;
    let mut different = 0;
    for (which, bits) in again {
        let place = all.iter().position(|known| *known == which).ok_or("a scene that was not there")?;
        different += usize::from(once[place] != bits);
    }
    let judged = once.iter().filter(|bits| bits.is_some()).count();
    if judged < all.len() / 2 {
        return Err(format!("only {judged} of {} scenes were not refused", all.len()));
    }
    Ok(Measured::new(different as f64, format!("of {judged}")))
}
