//! The command `twofold`.

fn main() -> std::process::ExitCode {
    twofold_command::commands::main()
}
