//! Shaders under test, and their linking.

use crate::{
    Error,
    linked::{Linked, TEXT, of_wesl},
};
use bytemuck::NoUninit;
use std::{fmt, path::Path, sync::Arc};
use wesl::{FileResolver, ModulePath, Resolver, Router, VirtualResolver, Wesl};
use wgpu::naga;

/// Makes a resolver of modules each time that a function is linked.
#[derive(Clone)]
struct Modules(Arc<dyn Fn() -> Box<dyn Resolver> + Send + Sync>);

impl fmt::Debug for Modules {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("Modules")
    }
}

/// A text in WGSL or WESL, a folder of modules in WESL, or both.
#[derive(Clone, Debug, Default)]
pub struct Shader {
    text: String,
    modules: Option<Modules>,
    features: Vec<String>,
    overrides: Vec<(String, f64)>,
    buffers: Vec<(String, Vec<u8>)>,
}

impl Shader {
    /// A text in WGSL, or in WESL without a package. Functions keep their names.
    pub fn new(text: impl Into<String>) -> Self {
        Self::default().text(text)
    }

    /// The WESL package in a folder: `package::shapes::area` is the function `area` in its file `shapes.wesl` or
    /// `shapes.wgsl`, and [`Gpu::map`](crate::Gpu::map) calls it `shapes::area`.
    pub fn package(folder: impl AsRef<Path>) -> Self {
        let folder = folder.as_ref().to_owned();
        Self::resolved_by(move || FileResolver::new(&folder))
    }

    /// A WESL package whose modules are not simply files of one folder. `make` is called once for each function that is
    /// linked.
    pub fn resolved_by<R: Resolver + 'static>(
        make: impl Fn() -> R + Send + Sync + 'static,
    ) -> Self {
        Self {
            modules: Some(Modules(Arc::new(move || Box::new(make())))),
            ..Self::default()
        }
    }

    /// Adds a text that imports modules of the package: `import package::shapes::area;`.
    #[must_use]
    pub fn text(mut self, text: impl Into<String>) -> Self {
        self.text = text.into();
        self
    }

    /// Switches a feature of WESL on, by which `@if(name)` selects code. All others are off.
    #[must_use]
    pub fn feature(mut self, name: &str) -> Self {
        self.features.push(name.to_owned());
        self
    }

    /// Sets an `override` of any module; a `bool` is 0 or 1.
    #[must_use]
    pub fn set(mut self, name: &str, value: f64) -> Self {
        self.overrides.push((name.to_owned(), value));
        self
    }

    /// Fills a buffer that the function reads, `@group(0) @binding(0) var<storage, read> name: …` or `var<uniform>`, in
    /// the layout of WGSL. The group is 0, 1 or 2. A buffer that the function does not read is ignored.
    #[must_use]
    pub fn buffer<T: NoUninit>(mut self, name: &str, contents: &[T]) -> Self {
        let contents = bytemuck::cast_slice(contents).to_vec();
        self.buffers.push((name.to_owned(), contents));
        self
    }

    /// Links a function and all that it needs. Paths have no `package::`.
    pub(crate) fn link(&self, function: &str) -> Result<Linked, Error> {
        let (module, name) = function.rsplit_once("::").unwrap_or((TEXT, function));
        let parse = |path: &str| {
            let path = path.parse::<ModulePath>();
            path.map_err(|error| Error::Shader(format!("`{function}`: {error}")))
        };
        let root = parse(&format!("package::{module}"))?;
        let mut router = Router::new();
        let mut text = VirtualResolver::new();
        text.add_module(parse("package")?, self.text.clone().into());
        router.mount_resolver(parse(&format!("package::{TEXT}"))?, text);
        if let Some(Modules(make)) = &self.modules {
            router.mount_fallback_resolver(make());
        }
        let mut compiler = Wesl::new(".").set_custom_resolver(router);
        compiler.keep_declarations(vec![name.to_owned()]);
        for feature in &self.features {
            compiler.set_feature(feature, true);
        }
        let linked = compiler.compile(&root);
        let linked = linked.map_err(|error| of_wesl(error, function))?;
        Ok(Linked {
            wgsl: linked.to_string(),
            syntax: linked.syntax,
            map: linked.sourcemap.unwrap_or_default(),
            root,
        })
    }

    /// The values of overrides, by their names in the linked text.
    pub(crate) fn overrides(
        &self,
        linked: &Linked,
        module: &naga::Module,
    ) -> Result<Vec<(String, f64)>, String> {
        let known: Vec<_> = (module.overrides.iter())
            .filter_map(|(_, item)| item.name.as_deref())
            .collect();
        let of = |(name, value): &(String, f64)| {
            let is_named = |known: &&&str| linked.source_name(known) == name;
            let found = known.iter().find(is_named);
            let found = found.ok_or_else(|| format!("reads no override `{name}`"))?;
            Ok(((*found).to_owned(), *value))
        };
        self.overrides.iter().map(of).collect()
    }

    /// The contents of the buffer of a source name.
    pub(crate) fn contents(&self, name: &str) -> Option<&[u8]> {
        let found = self.buffers.iter().find(|(known, _)| known == name);
        found.map(|(_, contents)| &**contents)
    }
}
