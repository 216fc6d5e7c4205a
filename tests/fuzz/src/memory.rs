//! Limits the memory of fuzz targets: memory out of proportion to the input is a fault.

use cap::Cap;
use std::alloc::System;
use std::panic;
use std::sync::Once;

#[global_allocator]
static CAPPED_ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

static PANIC_HOOK_INIT: Once = Once::new();

/// Runs a function within a memory limit. Aborts the process if all threads together need more than `bytes`.
pub(crate) fn with_memory_limit<T>(bytes: usize, run: impl FnOnce() -> T) -> T {
    // The report of a panic takes more memory than most inputs.
    PANIC_HOOK_INIT.call_once(|| {
        let hook = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let _ = CAPPED_ALLOCATOR.set_limit(usize::MAX);
            hook(info);
        }));
    });
    let most = CAPPED_ALLOCATOR.allocated().saturating_add(bytes);
    let _limit = MemoryLimitGuard::new(most);
    run()
}

struct MemoryLimitGuard;

impl MemoryLimitGuard {
    fn new(most: usize) -> Self {
        // It fails only if other threads have allocated as much in the meantime; then there is no limit.
        let _ = CAPPED_ALLOCATOR.set_limit(most);
        MemoryLimitGuard
    }
}

impl Drop for MemoryLimitGuard {
    fn drop(&mut self) {
        let _ = CAPPED_ALLOCATOR.set_limit(usize::MAX);
    }
}
