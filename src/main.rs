//! The command `kenzan`.

fn main() -> std::process::ExitCode {
    kenzan::cli::main()
}
