//! Builds glTF files in memory, and folders of temporary files, for tests.

#[cfg(feature = "gltf")]
pub(crate) use gltf::Gltf;

/// A folder of temporary files for one test, removed at the test's end.
pub(crate) struct Folder(pub(crate) std::path::PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ccd-decomp-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder for temporary files");
        Folder(folder)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> std::path::PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).expect("a temporary file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[cfg(feature = "gltf")]
mod gltf {
    use base64::Engine;
    use base64::engine::general_purpose::STANDARD;
    use serde_json::{Value, json};

    /// A glTF under construction: its JSON, and the bytes of its buffer.
    pub(crate) struct Gltf {
        pub(crate) json: Value,
        pub(crate) buffer: Vec<u8>,
    }

    impl Gltf {
        /// Creates a glTF with one unnamed node, whose mesh has no primitives yet.
        pub(crate) fn new() -> Self {
            let json = json!({
                "asset": {"version": "2.0"},
                "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": []}],
                "accessors": [],
                "bufferViews": [],
                "buffers": [],
            });
            let binary = Vec::new();
            Gltf {
                json,
                buffer: binary,
            }
        }

        /// Creates a glTF with one node and a mesh of one triangle, which has a corner at the origin.
        pub(crate) fn triangle() -> Self {
            let mut gltf = Gltf::new();
            let position =
                gltf.add_vec3_accessor(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
            gltf.add_primitive(json!({"attributes": {"POSITION": position}}));
            gltf
        }

        pub(crate) fn with_value(mut self, key: &str, value: Value) -> Self {
            self.json[key] = value;
            self
        }

        pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
            let list = self.json[list].as_array_mut().expect("a list");
            list.push(value);
            list.len() - 1
        }

        pub(crate) fn add_primitive(&mut self, value: Value) {
            let list = self.json["meshes"][0]["primitives"].as_array_mut();
            list.expect("a list").push(value);
        }

        /// Appends bytes to the buffer as a buffer view, and returns the view's index.
        pub(crate) fn add_buffer_view(&mut self, bytes: &[u8]) -> usize {
            while !self.buffer.len().is_multiple_of(4) {
                self.buffer.push(0);
            }
            let offset = self.buffer.len();
            self.buffer.extend(bytes);
            let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()});
            self.push("bufferViews", view)
        }

        pub(crate) fn add_vec3_accessor(&mut self, points: &[[f32; 3]]) -> usize {
            let bytes: Vec<u8> = points
                .iter()
                .flatten()
                .flat_map(|x| x.to_le_bytes())
                .collect();
            let view = self.add_buffer_view(&bytes);
            let about = json!({"bufferView": view, "componentType": 5126, "count": points.len(), "type": "VEC3"});
            self.push("accessors", about)
        }

        pub(crate) fn add_index_accessor(&mut self, numbers: &[u16]) -> usize {
            let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
            let view = self.add_buffer_view(&bytes);
            let about = json!({"bufferView": view, "componentType": 5123, "count": numbers.len(), "type": "SCALAR"});
            self.push("accessors", about)
        }

        /// Returns the file in the binary form, GLB.
        pub(crate) fn glb(&self) -> Vec<u8> {
            let mut json = self.json.clone();
            if json["buffers"] == json!([]) {
                json["buffers"] = json!([{"byteLength": self.buffer.len()}]);
            }
            let mut text = json.to_string().into_bytes();
            text.resize(text.len().next_multiple_of(4), b' ');
            let mut binary = self.buffer.clone();
            binary.resize(binary.len().next_multiple_of(4), 0);
            let mut bytes = b"glTF\x02\0\0\0".to_vec();
            bytes.extend((28 + text.len() as u32 + binary.len() as u32).to_le_bytes());
            for (kind, chunk) in [(b"JSON", text), (b"BIN\0", binary)] {
                bytes.extend((chunk.len() as u32).to_le_bytes());
                bytes.extend(kind);
                bytes.extend(chunk);
            }
            bytes
        }

        /// Returns the file in the text form, with the buffer at a URI.
        pub(crate) fn text_with_buffer_uri(&self, uri: &str) -> Vec<u8> {
            let mut json = self.json.clone();
            json["buffers"] = json!([{"byteLength": self.buffer.len(), "uri": uri}]);
            json.to_string().into_bytes()
        }

        /// Returns the file in the text form, with an embedded buffer.
        pub(crate) fn text_with_embedded_buffer(&self) -> Vec<u8> {
            let data = STANDARD.encode(&self.buffer);
            self.text_with_buffer_uri(&format!("data:application/octet-stream;base64,{data}"))
        }
    }
}
