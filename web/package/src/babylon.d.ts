import type {Tutte} from './index.js';

/**
 * Makes Babylon.js's glTF loader decode TUTTE_mesh_compression. `registerGLTFExtension` is Babylon's function of that name,
 * from `@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry` or `BABYLON.GLTF2`.
 */
export function registerTutte(
  registerGLTFExtension: (name: string, isGLTFExtension: boolean, factory: (loader: any) => any) => void,
  tutte: Tutte | Promise<Tutte>,
): void;
