// What the layers of every page are made of: materials, the order of drawing, textures of numbers, and the glass.
import {
  BackSide, BufferGeometry, CustomBlending, DataTexture, FrontSide, GLSL3, LineSegments, Mesh, OneFactor,
  OneMinusSrcAlphaFactor, RawShaderMaterial, Sphere, Vector2, Vector3, Vector4,
} from 'three';

import common from './shaders/common.glsl';
import meshFragment from './shaders/mesh.frag.glsl';
import meshVertex from './shaders/mesh.vert.glsl';

// The order of drawing: objects behind the glass, objects in it, its near side (depth first, so that only the nearest
// wall is visible), and objects shown in front of all others.
export const kOrder = {back: 0, content: 1, depth: 2, front: 3, crease: 4, picked: 5};

const kAllPoints = 0x7fffffff;

/** Uniforms that all layers share: set once, visible to every kernel. */
export function commonUniforms() {
  return {
    cutPlane: {value: new Vector4(0, 0, 0, 1)},
    leastAngleRadius: {value: new Vector2(-Infinity, -Infinity)},
    shownPoints: {value: new Vector2(0, kAllPoints)},
    insidePoints: {value: kAllPoints},
    colourBy: {value: 0},
    colourRange: {value: new Vector2(0, 1)},
    colourMap: {value: null},
    pixelRatio: {value: 1},
    pixelsPerUnit: {value: 1},
    viewport: {value: new Vector2(1, 1)},
    density: {value: 1},
    glass: {value: new Vector3()},
    painted: {value: 0},  // 1: the mesh has the colours of its corners instead of that of glass.
    crease: {value: new Vector3()},
  };
}

export function material(vertex, fragment, uniforms, options = {}) {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: vertex,
    fragmentShader: fragment,
    uniforms,
    transparent: true,  // All in one list, so that only `renderOrder` determines the order.
    ...options,
  });
}

/** Blends over the background, with the colour already multiplied by its share. */
export const kOver = {blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor, depthWrite: false};
export const kOpaque = {blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor};

export function placed(object, order) {
  object.renderOrder = order;
  object.frustumCulled = false;
  object.geometry.boundingSphere = new Sphere();  // Not needed; three.js would otherwise read a vertex as a position.
  return object;
}

export class MeshLayer {
  /** `geometry`: positions and normals of triangles, and possibly colours. */
  constructor(geometry, uniforms) {
    this.uniforms = uniforms;
    this.geometry = geometry;
    const coloured = geometry.getAttribute('paint') ? {PAINTED: ''} : {};
    const vertex = common + meshVertex, fragment = common + meshFragment;
    const plain = {defines: {PLAIN: ''}};
    this.objects = [
      placed(new Mesh(geometry, material(vertex, fragment, uniforms, {...kOver, side: BackSide, defines: {BACK: '', ...coloured}})),
        kOrder.back),
      placed(new Mesh(geometry, material(vertex, fragment, uniforms, {...plain, side: FrontSide, colorWrite: false,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2})), kOrder.depth),
      placed(new Mesh(geometry, material(vertex, fragment, uniforms, {...kOver, side: FrontSide, defines: coloured})), kOrder.front),
    ];
  }

  /** `fill`: writes the colours of all corners, four bytes each; null: glass. */
  paint(fill) {
    this.uniforms.painted.value = fill ? 1 : 0;
    if (!fill) return;
    const colours = this.geometry.getAttribute('paint');
    fill(colours.array);
    colours.needsUpdate = true;
  }

  /** Lines along creases. */
  addCreases(geometry) {
    const uniforms = {...this.uniforms, glass: this.uniforms.crease};
    const lines = new LineSegments(geometry, material(common + meshVertex, common + meshFragment, uniforms,
      {...kOver, defines: {PLAIN: ''}}));
    this.objects.push(placed(lines, kOrder.crease));
    return lines;
  }
}

/** 256 x 2 texels as a texture (shaders/attributes.glsl). */
export function colourMap(texels) {
  const texture = new DataTexture(texels, 256, 2);
  texture.needsUpdate = true;
  return texture;
}

/** Numbers as a texture, row by row; the last row is padded with zeros. */
export function numbers(array, components, format, type, internalFormat, widest) {
  const texels = Math.max(array.length / components, 1);
  const width = Math.min(texels, widest), height = Math.ceil(texels / width);
  const filled = new array.constructor(width * height * components);
  filled.set(array);
  const texture = new DataTexture(filled, width, height, format, type);
  texture.internalFormat = internalFormat;
  texture.needsUpdate = true;
  return texture;
}

/** A geometry of `count` corners; the kernels identify them by index. */
export function corners(count) {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, count);
  return geometry;
}

export const kCornersOfABall = 6;
