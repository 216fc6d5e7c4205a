//! Pickles an object as its constructor and arguments, so that unpickling gives the same bits.

use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};

/// The call by which pickle recreates an object: the class or class method, and the arguments.
pub(crate) struct ConstructorCall {
    /// The name of the class method, or `None` for the class itself.
    constructor_name: Option<&'static str>,
    arguments: Py<PyTuple>,
}

/// A callable and its arguments, as `__reduce__` returns them.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

impl ConstructorCall {
    pub(crate) fn new<'py, A>(
        py: Python<'py>,
        constructor: Option<&'static str>,
        arguments: A,
    ) -> PyResult<Self>
    where
        A: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error: Into<PyErr>>,
    {
        let arguments = arguments.into_pyobject(py).map_err(Into::into)?.unbind();
        Ok(ConstructorCall {
            constructor_name: constructor,
            arguments,
        })
    }

    /// Returns the constructor and the arguments of an object of `class`, as its `__reduce__` returns them.
    pub(crate) fn reduce_tuple<'py>(&self, class: Bound<'py, PyType>) -> PyResult<Reduced<'py>> {
        let arguments = self.arguments.bind(class.py()).clone();
        let constructor = match self.constructor_name {
            Some(name) => class.getattr(name)?,
            None => class.into_any(),
        };
        Ok((constructor, arguments))
    }
}
