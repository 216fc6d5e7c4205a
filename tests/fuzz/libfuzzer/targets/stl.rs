#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| (ccd_fuzz::targets::STL.run)(bytes));
