//! A long train, written segment by segment, equals that of one motion over the whole span.

use twofold::observables::pulsar::{arrivals, pulse_train};
use twofold::plan::Output;

use super::{PulseSummary, pulses::write_by_segments};
use crate::samples::Segments;
use crate::scene_file::{BUILT_IN, Scene};

/// tp-2 with both beams.
fn scene(span: f64, rho: f64) -> Scene {
    let toml = BUILT_IN.iter().find(|scene| scene.name == "tp-2").expect("tp-2").toml;
    let toml = toml
        .replace("span = 400", &format!("start = 5.0\nspan = {span:?}"))
        .replace("rho = 0.6", &format!("rho = {rho:?}\nsecond_beam = true"));
    Scene::from_toml("long", &toml).unwrap_or_else(|error| panic!("{error}"))
}

fn rows_of(scene: &Scene, rotation_per_segment: f64) -> (Vec<Vec<String>>, PulseSummary) {
    let plan = scene.plan(&[Output::Pulses]).expect("plan");
    let segments = Segments::with_rotation(scene, &plan, rotation_per_segment).expect("a motion");
    let mut table = Vec::new();
    let summary = write_by_segments(scene, segments, &mut table, |_| Ok(())).expect("pulses");
    let text = String::from_utf8(table).expect("text");
    (text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect(), summary)
}

/// Pulses that extend across the boundary of two segments are neither split nor counted twice, and turns are counted on:
/// forwards and backwards, with a beam so wide that the line of sight stays inside over several segments.
#[test]
fn pulses_across_segments_are_whole() {
    for (span, rho, per_segment) in
        [(1_000.0, 1.5, 130.0), (-1_000.0, 2.6, 130.0), (600.0, 2.0, 2.0), (-600.0, 2.0, 2.0)]
    {
        let scene = scene(span, rho);
        let (viewer, pulsar) = (scene.observer.expect("observer"), scene.pulsar.expect("pulsar"));
        let n = viewer.basis().direction;
        let (rows, summary) = rows_of(&scene, per_segment);
        assert_eq!(rows.len(), summary.pulses.iter().sum::<usize>());
        assert!(summary.without_turn.is_empty());

        let mut longest = 0.0_f64;
        let motion = scene.problem.taylor((0.0, span), 1e-13).expect("motion");
        for (beam, number) in [(pulsar.beam(), "1"), (pulsar.beam().opposite(), "2")] {
            let train = pulse_train(&motion, &beam, &n, (0.0, span)).expect("train");
            let (mut pulses, mut expected) =
                (train.pulses.clone(), arrivals(&motion, &beam, &n, &train).expect("arrivals"));
            if span < 0.0 {
                pulses.reverse();
                expected.reverse();
            }
            let found: Vec<_> = rows.iter().filter(|row| row[0] == number).collect();
            assert_eq!(found.len(), pulses.len(), "span {span}, beam {number}");
            assert!(summary.pulses.contains(&pulses.len()));
            assert!(rho > 2.5 || expected.len() > 3, "span {span}, beam {number}: {} whole pulses", expected.len());
            let first_turn = expected.first().map_or(0, |first| first.number);
            let mut expected = expected.into_iter();
            let mut last: Option<f64> = None;
            for (i, (row, pulse)) in found.iter().zip(&pulses).enumerate() {
                let field = |k: usize| row[k].parse::<f64>().expect("number");
                assert_eq!(row[1], (i + 1).to_string());
                longest = longest.max(if pulse.is_whole() { pulse.duration() } else { 0.0 });
                // The error of either motion, divided by a slow rate of m.n.
                let near = |a: f64, b: f64| (a - b).abs() < 1e-8;
                assert!(near(field(2), 5.0 + pulse.start) && near(field(3), 5.0 + pulse.end), "{row:?} {pulse:?}");
                assert!(near(field(4), 5.0 + pulse.midpoint()) && near(field(5), pulse.duration()));
                let cut =
                    ["", "start", "end", "both"][usize::from(pulse.cut_at_start) + 2 * usize::from(pulse.cut_at_end)];
                assert_eq!(row[6], cut);
                let midpoint = pulse.is_whole().then(|| pulse.midpoint());
                match midpoint.zip(last) {
                    Some((this, last)) => assert!(near(field(7), (this - last).abs())),
                    None => assert_eq!(row[7], ""),
                }
                if pulse.is_whole() {
                    let arrival = expected.next().expect("arrival");
                    assert_eq!(row[8], (arrival.number - first_turn).to_string(), "{row:?} {arrival:?}");
                    assert!(near(field(9), 5.0 + arrival.closest_approach), "{row:?} {arrival:?}");
                } else {
                    assert_eq!((row[8].as_str(), row[9].as_str()), ("", ""));
                }
                last = midpoint;
            }
        }
        let over_several = longest * scene.turning_rate() > 3.0 * per_segment;
        assert!(per_segment > 2.0 || over_several, "no pulse is longer than three segments: {longest}");
        let over: Vec<f64> =
            rows.iter().map(|row| row[if span < 0.0 { 2 } else { 3 }].parse().expect("number")).collect();
        assert!(over.windows(2).all(|pair| if span < 0.0 { pair[0] >= pair[1] } else { pair[0] <= pair[1] }));
    }
}
