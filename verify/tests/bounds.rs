//! The command `twofold bounds` as a user meets it: status, messages, output.

mod common;

use std::fs;
use std::path::Path;

use common::twofold;

/// Status 2, nothing on standard output, one message that contains the fragments.
fn assert_refused(table: &Path, fragments: &[&str]) {
    for extra in [&["--json"][..], &[]] {
        let output = twofold(&[&["bounds", table.to_str().expect("path in UTF-8")], extra].concat());
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{}: {message}", table.display());
        assert!(output.stdout.is_empty(), "{}: something on standard output", table.display());
        assert!(message.starts_with("error: ") && message.matches("error: ").count() == 1, "{message}");
        for fragment in fragments {
            assert!(message.contains(fragment), "{}: expected `{fragment}` in\n{message}", table.display());
        }
    }
}

#[test]
fn bad_tables_are_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/bad-pulsars");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("folder of bad tables") {
        let path = entry.expect("entry").path();
        let text = fs::read_to_string(&path).expect("text");
        let expected = text.lines().next().and_then(|line| line.strip_prefix("# expect: ")).expect("`# expect:`");
        assert_refused(&path, &expected.split(" | ").collect::<Vec<_>>());
        count += 1;
    }
    assert!(count >= 50, "only {count} bad tables found");
}

#[test]
fn files_that_are_no_tables_are_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    assert_refused(folder.path(), &["is a directory: a table of pulsars is a TOML file"]);
    assert_refused(&folder.path().join("none.toml"), &["is not a readable file"]);
    let latin_1 = folder.path().join("latin-1.toml");
    fs::write(&latin_1, b"about = \"\xe9toile\"\n").expect("file");
    assert_refused(&latin_1, &["is not UTF-8 text (byte 10): a table of pulsars is a TOML file"]);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/tp-1.toml");
    assert_refused(&scene, &["unknown key `star`: a table of pulsars has `about` and `pulsar`."]);
}

#[test]
fn the_built_in_table_is_printed_beside_the_paper() {
    let output = twofold(&["bounds"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    let text = String::from_utf8(output.stdout).expect("text");
    for name in ["PSR B1937+21, main pulse", "PSR B1937+21, interpulse", "PSR J1744-1134"] {
        assert!(text.contains(name), "{text}");
    }
    assert!(text.contains("printed") && text.contains("-18.861"), "{text}");

    let json = twofold(&["bounds", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    let change = &json[2]["figures"][0];
    assert_eq!((&json[2]["name"], &change["figure"]), (&"PSR J1744-1134".into(), &"lambda_change".into()));
    assert!((change["value"].as_f64().expect("number") - 1.566).abs() < 1e-3);
    assert_eq!(change["verdict"], "confirmed");
}

#[test]
fn a_table_of_ones_own_has_no_printed_numbers() {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("pulsars/paper.toml");
    let table = table.to_str().expect("path in UTF-8");
    let text = String::from_utf8(twofold(&["bounds", table]).stdout).expect("text");
    assert!(text.contains("-18.861") && !text.contains("verdict"), "{text}");
    let json: serde_json::Value = serde_json::from_slice(&twofold(&["bounds", table, "--json"]).stdout).expect("JSON");
    assert!(json[0]["figures"][0]["printed"].is_null());
}
