//! Setups that failed beside others that did not.

use crate::present::report::Failure;
use anyhow::{Result, bail};
use std::io::Write;

/// Prints the failures to standard error.
///
/// # Errors
/// All setups failed.
pub fn check_any<T>(runs: &[T], failures: &[Failure]) -> Result<()> {
    let reasons: Vec<String> = failures.iter().map(ToString::to_string).collect();
    if runs.is_empty() {
        match failures {
            [only] => bail!("{}", only.reason),
            _ => bail!("{}", reasons.join("\n")),
        }
    }
    for reason in reasons {
        // Without a standard error stream there is nobody to tell.
        let _ = writeln!(std::io::stderr(), "bspscope: {reason}");
    }
    Ok(())
}
