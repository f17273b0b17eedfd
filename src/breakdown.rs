//! A panic turned into a value: its message and place, and nothing on the terminal.
//!
//! Kenzan has no panic that it knows of. One that it does not know of costs the equation at which it happens, and no
//! other.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether a panic on this thread is caught, and so is nobody's business.
    static CAUGHT: Cell<bool> = const { Cell::new(false) };
    /// Where the last panic on this thread happened.
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// What the work gives.
///
/// # Errors
/// The message and the place of a panic. What the work was changing may be half done.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    silence();
    let outer = CAUGHT.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(work));
    CAUGHT.set(outer);
    outcome.map_err(|payload| {
        let place = PLACE.take().unwrap_or_else(|| "an unknown place".into());
        format!("{} ({place})", message(payload.as_ref()))
    })
}

/// Notes the place of a panic that is caught instead of printing it; all others are printed as before.
fn silence() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |info| if CAUGHT.get() { PLACE.set(place(info)) } else { before(info) }));
    });
}

/// `check/judge.rs:12:5`, the same on every machine: a path within the sources of Kenzan or of a crate that it uses.
fn place(info: &PanicHookInfo) -> Option<String> {
    let location = info.location()?;
    let file = location.file().replace('\\', "/");
    let file = match file.split_once("/src/") {
        Some((krate, rest)) => format!("{}/src/{rest}", krate.rsplit('/').next().unwrap_or_default()),
        None => file,
    };
    Some(format!("{file}:{}:{}", location.line(), location.column()))
}

fn message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("a panic without a message")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_its_message_and_place() {
        let told = caught(|| -> u8 { panic!("no {}", "luck") }).unwrap_err();
        assert!(told.starts_with("no luck (src/breakdown.rs:"), "{told}");
        let told = caught(|| -> u8 { "x".parse().unwrap() }).unwrap_err();
        assert!(told.contains("InvalidDigit") && told.contains("src/breakdown.rs:"), "{told}");
        assert_eq!(caught(|| 5), Ok(5));
    }

    #[test]
    fn within_what_is_caught_something_may_be_caught() {
        let outer = caught(|| {
            let inner = caught(|| -> u8 { panic!("inner") });
            assert!(inner.unwrap_err().starts_with("inner"));
            panic!("outer")
        });
        assert!(outer.map(|(): ()| 0).unwrap_err().starts_with("outer"));
    }
}
