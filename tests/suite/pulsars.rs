//! Tables of pulsars: the paper's table is as printed, every bad one is refused for the expected reason.

use std::fs;
use std::path::Path;

use twofold_scene::pulsar_table::{self, Pulsar, Spread, pulsars, pulsars_in_file};
use twofold_verify::refused_files::refused_files;

#[test]
fn the_built_in_table_is_that_of_the_paper() {
    let table = pulsar_table::paper();
    let printed = [
        ("PSR B1937+21, main pulse", [1.6e-3, 8.3, -48e-3, 100.0, 75.0, 15.0]),
        ("PSR B1937+21, interpulse", [1.6e-3, 10.0, 53e-3, 100.0, 105.0, 15.0]),
        ("PSR J1744-1134", [4.1e-3, 13.0, 20e-3, 95.0, 51.0, 15.0]),
    ];
    assert_eq!(table.len(), printed.len());
    for (pulsar, (name, values)) in table.iter().zip(printed) {
        assert_eq!(pulsar.name, name);
        let read = [pulsar.spin, pulsar.width, pulsar.width_change, pulsar.lambda, pulsar.chi, pulsar.years];
        assert_eq!(read.map(|quantity| quantity.value), values, "{name}");
        // Half a unit of the last printed digit; the change has an error instead, which is not from the paper.
        let rounding = [5e-5, if pulsar.width.value < 10.0 { 0.05 } else { 0.5 }, 0.5, 0.5, 0.5];
        let [spin, width, change, lambda, chi, years] = read;
        assert!(change.spread == Spread::Given && change.uncertainty > 0.0, "{name}: {change:?}");
        assert!(pulsar.source.as_ref().is_some_and(|source| source.contains("second-hand")), "{name}");
        for (quantity, rounding) in [spin, width, lambda, chi, years].iter().zip(rounding) {
            assert_eq!(quantity.spread, Spread::Rounded);
            assert!((quantity.uncertainty * 3f64.sqrt() / rounding - 1.0).abs() < 1e-12, "{name}: {quantity:?}");
        }
    }
}

/// The example of `docs/bounds.md`, verbatim.
#[test]
fn the_documented_table_is_accepted() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/bounds.md")).expect("page");
    let examples: Vec<_> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(examples.len(), 1);
    let table = pulsars("docs/bounds.md", examples[0]).unwrap_or_else(|error| panic!("{error}"));
    assert!(table.iter().all(|pulsar| pulsar.figures().is_ok()));
}

/// Two notations of a pulse give the same pulse.
#[test]
fn forms_of_a_number_are_the_same_number() {
    let one = |text: &str| -> Pulsar {
        pulsars("table", &format!("[[pulsar]]\nname = \"x\"\nwidth_change = 0.02\nyears = 15\n{text}"))
            .unwrap_or_else(|error| panic!("{error}"))
            .remove(0)
    };
    let first = one("spin_period = 4e-3\nlambda = 95\nchi = 51\nwidth = 13.0\n");
    let second = one(
        "spin_frequency = 250.0\nzeta = 85\nchi = 5.1e1\nwidth = [13, 0.05]\ninertia_over_c = 1.6211389382774e-6\n",
    );
    assert!(first.measured_change().is_none(), "a bare change is a limit");
    for (a, b) in first.figures().unwrap().iter().zip(second.figures().unwrap()) {
        assert!((a.value / b.value - 1.0).abs() < 1e-12, "{a:?}, {b:?}");
    }
    assert_eq!(first.chi, second.chi);
    assert_eq!((first.width.uncertainty, first.width.spread), (0.05 / 3f64.sqrt(), Spread::Rounded));
    assert_eq!((second.width.uncertainty, second.width.spread), (0.05, Spread::Given));
}

#[test]
fn every_bad_table_is_refused_for_the_reason_expected() {
    let files = refused_files("bad-pulsars");
    for (file, expected) in &files {
        let message = pulsars_in_file(file).expect_err(file).to_string();
        for fragment in expected {
            assert!(message.contains(fragment), "{file}: expected `{fragment}` in\n{message}");
        }
    }
    assert!(files.len() >= 50, "only {} bad tables found", files.len());
}
