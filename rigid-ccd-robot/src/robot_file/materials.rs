//! Removes what a URDF says about colours and textures, which may be wrong without harm.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, Writer};

/// Returns the text of a URDF without its materials. A text that is no XML is returned as it is: its parser says what is wrong.
pub(super) fn without_materials(text: &str) -> String {
    let is_material = |element: &BytesStart<'_>| element.name().as_ref() == b"material";
    let mut reader = Reader::from_str(text);
    let mut writer = Writer::new(Vec::new());
    loop {
        let kept = match reader.read_event() {
            Ok(Event::Eof) => break,
            Ok(Event::Start(element)) if is_material(&element) => {
                reader.read_to_end(element.name()).map(|_| None)
            }
            Ok(Event::Empty(element)) if is_material(&element) => Ok(None),
            other => other.map(Some),
        };
        let written = match kept {
            Ok(Some(event)) => writer.write_event(event).is_ok(),
            Ok(None) => true,
            Err(_) => false,
        };
        if !written {
            return text.to_owned();
        }
    }
    String::from_utf8(writer.into_inner()).unwrap_or_else(|_| text.to_owned())
}
