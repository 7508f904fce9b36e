//! The processor that measures.

use std::sync::LazyLock;
use sysinfo::{CpuRefreshKind, RefreshKind, System};

/// Returns the name of this machine's processor; `None` if the system does not tell it.
pub fn processor() -> Option<&'static str> {
    static NAME: LazyLock<Option<String>> = LazyLock::new(|| {
        let known = RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing());
        let system = System::new_with_specifics(known);
        let name = system.cpus().first()?.brand().trim().to_owned();
        Some(name).filter(|name| !name.is_empty())
    });
    NAME.as_deref()
}
