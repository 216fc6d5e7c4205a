//! The switch from parry in one line.

use anyhow::Result;
fn main() -> Result<()> {
    Ok(())
}
