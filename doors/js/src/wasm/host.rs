//! Messages to JavaScript besides answers: remarks on probable mistakes, and the text of a fault that ends the engine.

use rigid_ccd::Remark;
use rigid_ccd_robot::CellRemark;
use wasm_bindgen::prelude::wasm_bindgen;

// `doors/js/module/wasm.js` implements these functions.
#[wasm_bindgen(js_namespace = host)]
extern "C" {
    fn remark(kind: &str, text: &str);
    fn fault(text: &str);
}

/// Installs a panic hook, which passes the text of a fault to JavaScript. After a fault the memory is not reliable.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| fault(&info.to_string())));
}

/// Passes remarks to JavaScript. The kind of a remark is its text without numbers.
pub(crate) fn tell(remarks: impl IntoIterator<Item = Remark>) {
    for told in remarks {
        let kind = told.general_text();
        match told {
            Remark::OpenSeam { .. } => remark(
                kind,
                &format!(
                    "{told}; rounding the coordinates closes the seam, and so does BufferGeometryUtils.mergeVertices of three.js after normal and uv are deleted"
                ),
            ),
            _ => remark(kind, &told.to_string()),
        }
    }
}

/// Passes the warnings among the remarks on a robot or a cell to JavaScript. Warnings about input that
/// differ only in numbers are of the same kind.
pub(crate) fn tell_warnings(remarks: impl IntoIterator<Item = CellRemark>) {
    for told in remarks.into_iter().filter(CellRemark::is_warning) {
        let text = told.to_string();
        match told {
            CellRemark::Input { remark: input, .. } => remark(input.general_text(), &text),
            _ => remark(&text, &text),
        }
    }
}
