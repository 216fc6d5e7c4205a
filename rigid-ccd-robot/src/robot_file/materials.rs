//! Removes what a URDF says about colours and textures, which may be wrong without harm.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, Writer};

/// The largest depth of elements within each other. The parser of URDF files exhausts the stack at some thousands; robots have
/// five.
const MAX_DEPTH: usize = 200;

/// Returns the text of a URDF without its materials.
///
/// # Errors
/// For a text that is no XML, and for elements that are nested too deeply.
pub(super) fn without_materials(text: &str) -> Result<String, String> {
    let is_material = |element: &BytesStart<'_>| element.name().as_ref() == b"material";
    let mut reader = Reader::from_str(text);
    let mut writer = Writer::new(Vec::new());
    let mut depth = 0_usize;
    loop {
        let event = reader.read_event().map_err(|error| error.to_string())?;
        match &event {
            Event::Eof => break,
            Event::Start(element) if is_material(element) => {
                let end = reader.read_to_end(element.name());
                end.map_err(|error| error.to_string())?;
                continue;
            }
            Event::Empty(element) if is_material(element) => continue,
            Event::Start(_) => depth += 1,
            Event::End(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_DEPTH {
            return Err(format!("elements are nested more than {MAX_DEPTH} deep"));
        }
        writer
            .write_event(event)
            .map_err(|error| error.to_string())?;
    }
    String::from_utf8(writer.into_inner()).map_err(|error| error.to_string())
}
