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
pub fn write(output: impl io::Write, rows_to_write: &[Motions]) -> Result<(), csv::Error> {
    let names = TableKind::Motions.names();
    let defaults = cells(&Motions {
        id: String::new(),
        a: Motion::still(ccd_core::Pose::IDENTITY),
        b: Motion::still(ccd_core::Pose::IDENTITY),
        duration: 1.0,
    });
    let rows: Vec<Vec<String>> = rows_to_write.iter().map(cells).collect();
    // The parts of an orientation are kept or omitted together.
    let differs = |slot: usize| rows.iter().any(|row| row[slot] != defaults[slot]);
    let orientation = |side| TableKind::Motions.known_column_range(side, Quantity::Orientation);
    let kept_slots: Vec<usize> = (0..names.len())
        .filter(|&slot| {
            let orientation_slots = [Side::A, Side::B]
                .map(orientation)
                .into_iter()
                .find(|range| range.contains(&slot));
            slot == ID_COLUMN_INDEX
                || orientation_slots.map_or_else(|| differs(slot), |mut range| range.any(differs))
        })
        .collect();
    let mut writer = csv::Writer::from_writer(output);
    writer.write_record(kept_slots.iter().map(|&slot| &names[slot]))?;
    for row in &rows {
        writer.write_record(kept_slots.iter().map(|&slot| &row[slot]))?;
    }
    writer.flush()?;
    Ok(())
}

/// Returns the text of a query's cell in every known column.
fn cells(motions: &Motions) -> Vec<String> {
    let mut cells = vec![String::new(); TableKind::Motions.names().len()];
    cells[ID_COLUMN_INDEX].clone_from(&motions.id);
    cells[DURATION_COLUMN_INDEX] = motions.duration.to_string();
    for (side, motion) in [(Side::A, &motions.a), (Side::B, &motions.b)] {
        let rotation = motion.start().rotation();
        let mut set_cells = |quantity, values: &[f64]| {
            for (slot, value) in TableKind::Motions
                .known_column_range(side, quantity)
                .zip(values)
            {
                cells[slot] = value.to_string();
            }
        };
        set_cells(Quantity::Position, &motion.start().translation().to_array());
        let wxyz = [rotation.w, rotation.x, rotation.y, rotation.z];
        set_cells(Quantity::Orientation, &wxyz);
        set_cells(Quantity::Velocity, &motion.velocity().to_array());
        set_cells(
            Quantity::AngularVelocity,
            &motion.angular_velocity().to_array(),
        );
        set_cells(Quantity::Center, &motion.center().to_array());
    }
    cells
}
