//! Files of `tests/data` that must be refused. Their first line states parts of the message.

use std::fs;
use std::path::Path;

/// Paths of the files in a folder of `tests/data`, each with the parts of its message.
///
/// # Panics
/// If the folder cannot be read, or a file does not state its message.
pub fn refused_files(folder: &str) -> Vec<(String, Vec<String>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data").join(folder);
    let paths = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let with_message = |path: std::path::PathBuf| {
        let text = fs::read_to_string(&path).expect("a text");
        let expected = text.lines().next().and_then(|line| line.strip_prefix("# expect: "));
        let expected = expected.unwrap_or_else(|| panic!("{}: no `# expect:`", path.display()));
        (path.to_str().expect("a path in UTF-8").to_owned(), expected.split(" | ").map(str::to_owned).collect())
    };
    paths.map(with_message).collect()
}
