#![no_main]

libfuzzer_sys::fuzz_target!(init: ccd_fuzz::ignore_caught_panics(), |bytes: &[u8]| (ccd_fuzz::targets::STORED_BODY.run)(bytes));
