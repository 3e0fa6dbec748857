//! Target `changes` of `teeter-fuzz` under libFuzzer.
#![no_main]

use libfuzzer_sys::fuzz_target;
use teeter_fuzz::Target;

fuzz_target!(|bytes: &[u8]| (Target::named("changes").run)(bytes));
