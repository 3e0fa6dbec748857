//! Target: an ini file of the simulators of 2003.

use teeter_dissertation::jenga3d::Constants;

/// Reads bytes as an ini file. What is accepted is the same after it is written and read again.
pub fn run(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    if let Ok(constants) = Constants::from_ini(&text) {
        let ini = constants.to_ini();
        let again = Constants::from_ini(&ini).expect("what was written can be read");
        // The text stands for the constants: a number that is none differs from itself.
        assert_eq!(again.to_ini(), ini);
    }
}

/// The constants of the dissertation.
pub fn seeds() -> Vec<Vec<u8>> {
    vec![Constants::default().to_ini().into_bytes()]
}
