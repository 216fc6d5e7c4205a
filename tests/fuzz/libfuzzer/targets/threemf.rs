#![no_main]

libfuzzer_sys::fuzz_target!(init: ccd_fuzz::let_caught_panics_pass(), |bytes: &[u8]| (ccd_fuzz::targets::THREEMF.run)(bytes));
