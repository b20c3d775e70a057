// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Appearance of OBJ files: splits their surfaces by material and reads the MTL files.
#include "Appearance.h"

#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Formats/MeshReaders.h"
#include "MtlFile.h"
#include "Processes/CommandError.h"
#include "TextureImages.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTexture.h"
#include "vtkTransform.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <sstream>
#include <vector>

namespace penumbra
{

namespace
{

/// The cells of one material: those of each kind, and their ids.
struct Part
{
  vtkNew<vtkCellArray> Cells[3];
  vtkNew<vtkIdList> Ids;
};

/// Makes the mesh of a part, without the points that it does not use.
vtkSmartPointer<vtkPolyData> MakeMesh(vtkPolyData* whole, const Part& part)
{
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(whole->GetPoints());
  mesh->GetPointData()->ShallowCopy(whole->GetPointData());
  mesh->SetVerts(part.Cells[0]);
  mesh->SetLines(part.Cells[1]);
  mesh->SetPolys(part.Cells[2]);
  mesh->GetCellData()->CopyAllocate(whole->GetCellData(), part.Ids->GetNumberOfIds());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(OriginalCellIds);
  for (vtkIdType i = 0; i < part.Ids->GetNumberOfIds(); ++i)
  {
    mesh->GetCellData()->CopyData(whole->GetCellData(), part.Ids->GetId(i), i);
    ids->InsertNextValue(part.Ids->GetId(i));
  }
  mesh->GetCellData()->AddArray(ids);
  return RemoveUnusedPoints(mesh);
}

/// Returns one mesh per value of `ids`, with the arrays of the whole mesh and its cell ids, OriginalCellIds.
std::map<int, vtkSmartPointer<vtkPolyData>> SplitByMaterial(vtkPolyData* mesh, vtkDataArray* ids)
{
  std::map<int, Part> parts;
  vtkCellArray* kinds[3] = { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys() };
  vtkNew<vtkIdList> corners;
  vtkIdType cell = 0;
  for (int kind = 0; kind < 3; ++kind)
  {
    for (vtkIdType i = 0; i < kinds[kind]->GetNumberOfCells(); ++i, ++cell)
    {
      kinds[kind]->GetCellAtId(i, corners);
      Part& part = parts[static_cast<int>(ids->GetComponent(cell, 0))];
      part.Cells[kind]->InsertNextCell(corners);
      part.Ids->InsertNextId(cell);
    }
  }
  std::map<int, vtkSmartPointer<vtkPolyData>> result;
  for (const auto& [id, part] : parts)
  {
    result[id] = MakeMesh(mesh, part);
  }
  return result;
}

namespace fs = std::filesystem;

bool IsFile(const fs::path& path)
{
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Returns the path of a file that `folder` contains or that `name` leads to from there; empty: there
/// is none.
std::string FindFile(const fs::path& folder, const std::string& name)
{
  for (const fs::path& path : { folder / name, folder / fs::path(name).filename() })
  {
    if (!name.empty() && IsFile(path))
    {
      return path.string();
    }
  }
  return {};
}

class Importer
{
public:
  Importer(const std::string& path, Appearance& appearance)
    : Folder(fs::path(path).parent_path()),
      Result(appearance)
  {
  }

  /// Reads the files of materials that `mesh` names.
  void ReadLibraries(vtkDataSet* mesh)
  {
    auto* names =
      vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray(ObjLibraryNames));
    for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
    {
      const std::string line = names->GetValue(i);
      if (!this->ReadLibrary(line))
      {
        // The line may name several files.
        std::istringstream words(line);
        bool complete = line.find(' ') != line.npos;
        for (std::string word; words >> word;)
        {
          complete = this->ReadLibrary(word) && complete;
        }
        if (!complete)
        {
          this->Result.Warnings.push_back(
            "its materials in '" + line + "' are missing; copy the file to the folder of the mesh");
        }
      }
    }
  }

  /// Warns of materials whose opacity is in an image other than that of their color.
  void ReportOpacityTextures()
  {
    const auto isLost = [](const auto& material) {
      const std::string& texture = material.second.OpacityTexture;
      return !texture.empty() && texture != material.second.Texture;
    };
    const auto count = std::count_if(this->Materials.begin(), this->Materials.end(), isLost);
    if (count > 0)
    {
      this->Result.Warnings.push_back("the opacity textures (map_d) of " + std::to_string(count) +
        (count == 1 ? " material are" : " materials are") +
        " not drawn; put the opacity into the alpha channel of map_Kd");
    }
  }

  bool HasMaterials() const { return !this->Materials.empty(); }

  /// Returns an actor with a material; null: the material does not exist.
  vtkSmartPointer<vtkActor> MakeActor(const std::string& name)
  {
    const auto found = this->Materials.find(name);
    if (found == this->Materials.end())
    {
      if (this->Missing.insert(name).second)
      {
        this->Result.Warnings.push_back("its material '" + name + "' is in none of its MTL files");
      }
      return nullptr;
    }
    const MtlMaterial& material = found->second;
    auto actor = vtkSmartPointer<vtkActor>::New();
    vtkProperty* property = actor->GetProperty();
    const std::array<double, 3>& color = material.Diffuse;
    property->SetColor(color[0], color[1], color[2]);
    const std::array<double, 3>& emission = material.Emission;
    property->SetAmbientColor(emission[0], emission[1], emission[2]);
    property->SetAmbient(*std::max_element(emission.begin(), emission.end()) > 0.0 ? 1.0 : 0.0);
    property->SetSpecularColor(material.Specular[0], material.Specular[1], material.Specular[2]);
    property->SetOpacity(material.Opacity);
    property->SetInterpolationToPhong();
    property->SetLighting(material.Illumination != 0);
    property->SetSpecular(material.Illumination > 1 && material.SpecularExponent > 0.0 ? 1.0 : 0.0);
    constexpr double BlinnToPhong = 0.25; // as in vtkOBJImporter
    property->SetSpecularPower(BlinnToPhong * material.SpecularExponent);
    if (!material.Texture.empty())
    {
      actor->SetTexture(this->FindTexture(material));
    }
    return actor;
  }

private:
  bool ReadLibrary(std::string name)
  {
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::string path = FindFile(this->Folder, name);
    if (path.empty())
    {
      return false;
    }
    RecordInput(path);
    return ReadMtl(path, this->Materials);
  }

  vtkSmartPointer<vtkTexture> FindTexture(const MtlMaterial& material)
  {
    std::ostringstream key;
    key << material.Texture << '\n'
        << material.TextureScale[0] << ' ' << material.TextureScale[1] << ' '
        << material.TextureOffset[0] << ' ' << material.TextureOffset[1];
    const auto [entry, isNew] = this->Textures.emplace(key.str(), nullptr);
    if (isNew)
    {
      entry->second = this->MakeTexture(material);
    }
    return entry->second;
  }

  vtkSmartPointer<vtkTexture> MakeTexture(const MtlMaterial& material)
  {
    const std::string path = FindFile(this->Folder, material.Texture);
    vtkSmartPointer<vtkImageData> image;
    try
    {
      image = path.empty() ? nullptr : ReadImage(path);
    }
    catch (const CommandError&)
    {
      image = nullptr;
    }
    catch (const std::bad_alloc&) // The size in the file is damaged.
    {
      image = nullptr;
    }
    if (!image)
    {
      this->Result.Warnings.push_back("the texture '" + material.Texture +
        (path.empty() ? "' is missing" : "' cannot be read") +
        "; its surfaces are drawn without it");
      return nullptr;
    }
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    ConvertToBytes(texture);
    texture->InterpolateOn();
    texture->MipmapOn();
    vtkNew<vtkTransform> transform;
    transform->Translate(material.TextureOffset[0], material.TextureOffset[1], 0.0);
    transform->Scale(material.TextureScale[0], material.TextureScale[1], 1.0);
    if (!transform->GetMatrix()->IsIdentity())
    {
      texture->SetTransform(transform);
    }
    return texture;
  }

  const fs::path Folder;
  Appearance& Result;
  MtlMaterials Materials;
  std::set<std::string> Missing; ///< materials that were reported
  std::map<std::string, vtkSmartPointer<vtkTexture>> Textures;
};

/// Shows the colors of vertices, if `mesh` has any and the actor has no texture. Mapped colors replace the emission.
void ShowColors(vtkDataSet* mesh, vtkActor* actor, Appearance& appearance)
{
  if (actor && !actor->GetTexture() && mesh->GetPointData()->GetScalars())
  {
    if (actor->GetProperty()->GetAmbient() > 0.0)
    {
      actor->GetProperty()->SetAmbient(0.0);
      const std::string warning =
        "emission of materials (Ke) was left out, because vertices have colors";
      if (std::find(appearance.Warnings.begin(), appearance.Warnings.end(), warning) ==
        appearance.Warnings.end())
      {
        appearance.Warnings.push_back(warning);
      }
    }
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(vtkPolyData::SafeDownCast(mesh));
    mapper->SetScalarModeToUsePointData();
    actor->SetMapper(mapper);
  }
}

}

vtkSmartPointer<vtkDataObject> ImportObj(
  const std::string& path, vtkDataObject* data, Appearance& appearance)
{
  Importer importer(path, appearance);
  const std::vector<vtkDataSet*> meshes = FindDataSets(data);
  if (!meshes.empty())
  {
    importer.ReadLibraries(meshes.front());
    importer.ReportOpacityTextures();
  }
  if (!importer.HasMaterials())
  {
    for (vtkDataSet* leaf : meshes)
    {
      appearance.Actors.push_back(
        leaf->GetPointData()->GetScalars() ? vtkSmartPointer<vtkActor>::New() : nullptr);
      ShowColors(leaf, appearance.Actors.back(), appearance);
    }
    return data;
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (vtkDataSet* leaf : meshes)
  {
    auto* mesh = vtkPolyData::SafeDownCast(leaf);
    auto* names =
      vtkStringArray::SafeDownCast(leaf->GetFieldData()->GetAbstractArray(ObjMaterialNames));
    vtkDataArray* ids = leaf->GetCellData()->GetArray(ObjMaterialIds);
    if (!mesh || !names || !ids)
    {
      continue;
    }
    for (const auto& [id, part] : SplitByMaterial(mesh, ids))
    {
      blocks->SetBlock(blocks->GetNumberOfBlocks(), part);
      const bool isKnown = id >= 0 && id < names->GetNumberOfValues();
      vtkSmartPointer<vtkActor> actor = isKnown ? importer.MakeActor(names->GetValue(id)) : nullptr;
      if (!actor && leaf->GetPointData()->GetScalars())
      {
        actor = vtkSmartPointer<vtkActor>::New();
      }
      ShowColors(leaf, actor, appearance);
      appearance.Actors.push_back(actor);
    }
  }
  return blocks;
}

}
