#![no_main]

#[path = "../survive.rs"]
mod survive;

libfuzzer_sys::fuzz_target!(|data: &[u8]| survive::tex(data));
