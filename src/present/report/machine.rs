//! The machine on which a report was made, and the time.

use crate::measure::processor;
use crate::present::number::Digits;
use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use time::OffsetDateTime;
use time::macros::format_description;

/// The machine of a report. Unknown entries are a dash.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub processor: String,
    pub cores: String,
    /// Physical memory.
    pub memory: String,
    pub system: String,
    /// Version of this program, and its target platform.
    pub version: String,
}

impl Machine {
    /// Returns the current machine.
    pub fn here() -> Self {
        let known = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
        let system = System::new_with_specifics(known);
        let dash = || "–".to_owned();
        let threads = std::thread::available_parallelism();
        let physical = System::physical_core_count();
        let memory = system.total_memory();
        Machine {
            processor: processor().map_or_else(dash, str::to_owned),
            cores: match (physical, threads) {
                (Some(cores), Ok(threads)) => format!("{cores}, {threads} threads at once"),
                (None, Ok(threads)) => format!("{threads} threads at once"),
                (Some(cores), Err(_)) => cores.to_string(),
                (None, Err(_)) => dash(),
            },
            memory: match memory {
                0 => dash(),
                bytes => Digits::Three.bytes(bytes as f64),
            },
            system: System::long_os_version().unwrap_or_else(dash),
            version: format!(
                "bspscope {} for {} on {}",
                env!("CARGO_PKG_VERSION"),
                std::env::consts::ARCH,
                std::env::consts::OS
            ),
        }
    }
}

/// Returns the current date and time in UTC, as reports show it.
pub fn now() -> String {
    let format = format_description!("[year]-[month]-[day] [hour]:[minute] UTC");
    let now = OffsetDateTime::now_utc();
    now.format(&format)
        .unwrap_or_else(|_| now.date().to_string())
}
