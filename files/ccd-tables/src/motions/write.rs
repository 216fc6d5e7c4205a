//! Writes the table of motions as CSV.

use super::Motions;
use crate::columns::{DURATION_COLUMN_INDEX, ID_COLUMN_INDEX, Quantity, Side, TableKind};
use ccd_core::Motion;
use std::io;

/// Writes motions as start poses and velocities; columns with their default in every row are omitted.
///
/// Numbers read back to the same bits, orientations up to rounding.
///
/// # Errors
/// `output` cannot be written to.
pub fn write(output: impl io::Write, queries: &[Motions]) -> Result<(), csv::Error> {
    let names = TableKind::Motions.names();
    let defaults = cells(&Motions {
        id: String::new(),
        a: Motion::still(ccd_core::Pose::IDENTITY),
        b: Motion::still(ccd_core::Pose::IDENTITY),
        duration: 1.0,
    });
    let rows: Vec<Vec<String>> = queries.iter().map(cells).collect();
    // The parts of an orientation are kept or omitted together.
    let differs = |slot: usize| rows.iter().any(|row| row[slot] != defaults[slot]);
    let orientation = |side| TableKind::Motions.known_column_range(side, Quantity::Orientation);
    let kept: Vec<usize> = (0..names.len())
        .filter(|&slot| {
            let whole = [Side::A, Side::B]
                .map(orientation)
                .into_iter()
                .find(|range| range.contains(&slot));
            slot == ID_COLUMN_INDEX
                || whole.map_or_else(|| differs(slot), |mut range| range.any(differs))
        })
        .collect();
    let mut writer = csv::Writer::from_writer(output);
    writer.write_record(kept.iter().map(|&slot| &names[slot]))?;
    for row in &rows {
        writer.write_record(kept.iter().map(|&slot| &row[slot]))?;
    }
    writer.flush()?;
    Ok(())
}

/// Returns the text of a query's cell in every known column.
fn cells(query: &Motions) -> Vec<String> {
    let mut cells = vec![String::new(); TableKind::Motions.names().len()];
    cells[ID_COLUMN_INDEX].clone_from(&query.id);
    cells[DURATION_COLUMN_INDEX] = query.duration.to_string();
    for (side, motion) in [(Side::A, &query.a), (Side::B, &query.b)] {
        let rotation = motion.start().rotation();
        let mut put = |quantity, values: &[f64]| {
            for (slot, value) in TableKind::Motions
                .known_column_range(side, quantity)
                .zip(values)
            {
                cells[slot] = value.to_string();
            }
        };
        put(Quantity::Position, &motion.start().translation().to_array());
        let wxyz = [rotation.w, rotation.x, rotation.y, rotation.z];
        put(Quantity::Orientation, &wxyz);
        put(Quantity::Velocity, &motion.velocity().to_array());
        put(
            Quantity::AngularVelocity,
            &motion.angular_velocity().to_array(),
        );
        put(Quantity::Center, &motion.center().to_array());
    }
    cells
}
